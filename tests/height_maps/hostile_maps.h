// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sums of height maps that are hard to round: parts that cancel or nearly do, equal heights and distances, far tails, level
// places, tiny and huge numbers; and positions on such maps where a tie, the surface or a kink is near or met.

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "forceshade/height_map.h"

namespace forceshade::tests {

struct HostileMap {
  HeightMap map;
  height::Mode mode;
  float stiffness;  // N/mm
};

// The same sequence for the same seed.
class HostileMaps {
 public:
  explicit HostileMaps(std::uint64_t seed) : random_(seed) {}

  HostileMap next_map();

  // surface(x, y): what z lies on where the penetration is 0, mm; any estimate of it.
  template <class Surface>
  Eigen::Vector3f next_position(const HostileMap& on, const Surface& surface) {
    const float x = coordinate_on(on, &Spot::x), y = coordinate_on(on, &Spot::y);
    return {x, y, height_at(x, y, surface)};
  }

 private:
  // A centre, a rim, a knot or the like, and the length on which the part changes.
  struct Spot {
    float x, y, reach;
  };

  std::uint64_t pick(std::uint64_t count) { return random_() % count; }
  bool once_in(std::uint64_t count) { return pick(count) == 0; }
  float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  template <std::size_t kCount>
  float one_of(const float (&choices)[kCount]) {
    return choices[pick(kCount)];
  }
  // By bit pattern, of any size between the two.
  float any_size(float low, float high);
  float either_sign(float size) { return once_in(2) ? size : -size; }

  float coordinate();
  float height();
  float tiny_or_any();
  float reach();
  height::Shape shape();
  height::Shape polygons();
  height::Shape grid();
  // An earlier part again: the same, negated, mirrored or with another height.
  height::Part relative_of(height::Part part);
  std::vector<height::Part> sum();

  Spot spot_of(const height::Part& part);
  float coordinate_on(const HostileMap& on, float Spot::*axis);
  template <class Surface>
  float height_at(float x, float y, const Surface& surface) {
    const std::uint64_t choice = pick(8);
    if (choice < 3) return height_without_surface();
    const auto z = static_cast<float>(surface(x, y));
    return beside_surface(z);
  }
  float height_without_surface();
  float beside_surface(float z);

  std::mt19937_64 random_;
};

}  // namespace forceshade::tests
