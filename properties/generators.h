// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Generators of positions, pairs and closed paths. Simpler ones have rounder numbers or fewer corners.

#include <array>
#include <vector>

#include "properties/height_positions.h"
#include "properties/positions.h"
#include "properties/work.h"

namespace forceshade::properties {

// A position of every kind that PositionSource has, the invalid ones included.
Generator<Eigen::Vector3f> position_of(const reference::Law& law);

// A valid position and one a few binary32 steps away in x and z; or, for the cylinders, its mirror image in the axis.
struct NearbyPair {
  Eigen::Vector3f a;
  int x_steps = 0, z_steps = 0;
  bool across_axis = false;

  Eigen::Vector3f b(const LawClaims& claims) const;
};
Generator<NearbyPair> pair_of(const reference::Law& law);

// On a height map. The law and its claims must outlive the generator.
struct HeightTarget {
  const reference::HeightMapField& law;
  const HeightMapClaims& claims;
};
Generator<Eigen::Vector3f> position_of(const HeightTarget& map);

// A valid position, on a line or rim of the map as often as not, and one a few binary32 steps away.
struct Neighbours {
  Eigen::Vector3f a;
  std::array<int, 3> steps{};

  Eigen::Vector3f b() const;
};
Generator<Neighbours> neighbours_on(const HeightTarget& map);

// A closed polygon of 3 to 6 corners in and around the surface, as large as a part or much smaller.
Generator<std::vector<Eigen::Vector3f>> polygon_of(const HeightTarget& map);

// A closed polygon of 3 to 8 corners in and around the object, self-crossing or not.
Generator<std::vector<PathPoint>> polygon_of(const reference::Law& law);

}  // namespace forceshade::properties
