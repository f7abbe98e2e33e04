// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Binary32 numbers by their bits: neighbours, spacing, and how a message shows one.

#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace forceshade::properties {

// The number `steps` places further up the line of finite binary32 numbers and infinities (down if negative).
inline float neighbour(float value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, HUGE_VALF);
  for (; steps < 0; ++steps) value = std::nextafter(value, -HUGE_VALF);
  return value;
}

// Half the distance to the next binary32 away from zero: what rounding may have added or taken.
inline double half_spacing(float value) {
  const float size = std::fabs(value);
  return 0.5 * (static_cast<double>(std::nextafter(size, HUGE_VALF)) - static_cast<double>(size));
}

inline bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// "0x1.8p+1 (3)".
std::string show(float value);
std::string show(const Eigen::Vector3f& value);

}  // namespace forceshade::properties
