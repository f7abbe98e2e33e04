// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The concept of the numbers in the exact stages: a value with a proven error bound, and comparisons that may say "unknown".
//
// A Ball type N (DoubleDouble, BigFloatBall<>) offers N::exactly(double), + - * /, square_root(N), sign(N), midpoint(N) (the
// same value with the error dropped), truncated(N, bits) (as midpoint, but good to `bits` bits is enough), widened(N, k) (the
// error set to 2^k times the value) and approximately(N) -> double.

#include <cmath>
#include <optional>

namespace forceshade::fast {

enum class Sign { negative, zero, positive, unknown };

template <class N>
Sign sign_of_difference(const N& value, double other) noexcept {
  return sign(value - N::exactly(other));
}

// Its sign where that is proved, zero included; BigFloatBall, whose sign() takes what is near zero for it, has one of its own.
template <class N>
Sign proved_sign(const N& value) noexcept {
  return sign(value);
}

// The binary32 nearest to the number that `value` encloses, ties to even; empty when the enclosure does not decide it.
// The candidates are the binary32 nearest to the midpoint and its two neighbours; a rounding boundary between binary32
// neighbours is a binary64 number, so each comparison is with an exact number.
//
// sign_beside(tie): the sign of the number less a tie.
template <class SignBeside>
std::optional<float> round_to_binary32(double approximation, const SignBeside& sign_beside) noexcept {
  float candidate = static_cast<float>(approximation);
  for (int step = 0; step < 3; ++step) {
    const float above = std::nextafter(candidate, HUGE_VALF);
    const float below = std::nextafter(candidate, -HUGE_VALF);
    const Sign up = sign_beside(0.5 * (static_cast<double>(candidate) + static_cast<double>(above)));
    const Sign down = sign_beside(0.5 * (static_cast<double>(candidate) + static_cast<double>(below)));
    if (up == Sign::unknown || down == Sign::unknown) return std::nullopt;
    const bool candidate_is_even = (__builtin_bit_cast(unsigned, candidate) & 1U) == 0;
    if (up == Sign::positive || (up == Sign::zero && !candidate_is_even)) {
      candidate = above;
    } else if (down == Sign::negative || (down == Sign::zero && !candidate_is_even)) {
      candidate = below;
    } else {
      return candidate + 0.0F;  // -0 becomes +0
    }
  }
  return std::nullopt;
}

template <class N>
std::optional<float> round_to_binary32(const N& value) noexcept {
  return round_to_binary32(approximately(value), [&](double tie) { return sign_of_difference(value, tie); });
}

}  // namespace forceshade::fast
