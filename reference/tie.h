// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rounding to binary32 once an exact comparison with the middle between two neighbours has been made.

namespace forceshade::reference {

// Of two neighbouring binary32, the one that a number between them rounds to, ties to even; `sign` is that of the number less
// their middle. A zero is +0.
inline float rounded_between(float below, float above, int sign) {
  const bool below_is_even = (__builtin_bit_cast(unsigned, below) & 1U) == 0;
  return (sign < 0 || (sign == 0 && below_is_even) ? below : above) + 0.0F;
}

}  // namespace forceshade::reference
