// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rounding to binary32 once an exact comparison with the middle between two neighbours has been made, and how near that middle
// is.

#include <cmath>

#include "reference/numbers/ball64.h"

namespace forceshade::reference {

// The one of two neighbouring binary32 that a number between them rounds to, ties to even; `sign` is that of the number less
// their middle. A zero is +0.
inline float rounded_between(float below, float above, int sign) {
  const bool below_is_even = (__builtin_bit_cast(unsigned, below) & 1U) == 0;
  return (sign < 0 || (sign == 0 && below_is_even) ? below : above) + 0.0F;
}

// The distance of `value` from the tie nearest to it, in units in the last place of `rounded`, the binary32 nearest to it.
inline float ulps_from_tie(const Ball64& value, float rounded) {
  if (rounded == 0) return 0.5F;
  const float size = std::fabs(rounded);
  const long double ulp = static_cast<long double>(std::nextafter(size, 2 * size)) - static_cast<long double>(size);
  return static_cast<float>(0.5L - std::fabs(value.mid() - static_cast<long double>(rounded)) / ulp);
}

}  // namespace forceshade::reference
