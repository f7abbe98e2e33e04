// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Coordinates as integers: each is a whole multiple of 2^-53 mm, because binary32 has 24 bits and none but 0 is below 2^-30.

#include <cmath>
#include <cstdint>

namespace forceshade::mesh {

constexpr int kCoordinateBits = 53;

// In units of 2^-53 mm; a Whole has 68 bits or more.
template <class Whole>
Whole whole_coordinate(float x) {
  int exponent = 0;
  const float fraction = std::frexp(x, &exponent);
  const auto bits = static_cast<std::int64_t>(std::ldexp(fraction, 24));  // x = bits * 2^(exponent - 24)
  const int shift = exponent - 24 + kCoordinateBits;
  return shift >= 0 ? Whole(bits) << shift : Whole(bits >> -shift);  // the bits that go are 0
}

}  // namespace forceshade::mesh
