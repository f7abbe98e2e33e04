// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The truth about a height map's force: rounded to binary32, with proof (docs/height-maps.md).

#include <Eigen/Core>
#include <array>
#include <variant>

#include "reference/law.h"
#include "rendering/height_map.h"

namespace forceshade::reference {

// Immutable and safe to share between threads.
class HeightMapField {
 public:
  static std::variant<HeightMapField, ParameterError> build(HeightMap map, height::Rendering rendering, float stiffness);

  const HeightMap& map() const { return map_; }
  height::Rendering rendering() const { return rendering_; }
  float stiffness() const { return stiffness_; }

  // The same as Law::round_to_binary32: every answer is decided. What enclosures of 768 bits leave open, exact sums decide.
  Rounded round_to_binary32(const Eigen::Vector3f& position) const;

  // U_x and U_y at a place of the plane within the domain, mm: each the binary32 nearest to the exact one, ties to even, and 0
  // below 2^-30 in size.
  std::array<float, 2> slopes(float x, float y) const;

  // The force at a valid position to about 17 digits, and what it is made of, for properties that need a size, not a proof.
  // Where the gap is not positive there is no force, whatever x, y and z say.
  struct Estimate {
    Ball64 gap;      // mm: the penetration
    Ball64 Ux, Uy;   // mm/mm: the gradient that the direction comes from
    Ball64 x, y, z;  // N
  };
  Estimate estimate(const Eigen::Vector3f& position) const;

 private:
  HeightMapField(HeightMap map, height::Rendering rendering, float stiffness)
      : map_(std::move(map)), rendering_(rendering), stiffness_(stiffness) {}

  HeightMap map_;
  height::Rendering rendering_;
  float stiffness_;
};

}  // namespace forceshade::reference
