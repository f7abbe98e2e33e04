// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The first stage's number for height maps: a binary64 with a proven bound of its own error, a Ball (fast/numbers/ball.h).

#include <cmath>
#include <optional>

#include "fast/numbers/ball.h"
#include "fast/numbers/inline.h"

namespace forceshade::fast {

// |true value - value| <= error. An operation charges 2^-53 of its result, which holds unless that is subnormal, and what it
// hands on; kSlack covers the bound's own roundings, at most seven. No result within a jet is below kLeastResult in size
// without being 0: tests/fast/height_bounds_test.cpp derives it from the domain. The bound's own products may be subnormal, and
// lose 2^-1075 then, which kSlack covers too.
struct DoubleWithError {
  double value = 0, error = 0;

  static constexpr double kUnit = 0x1p-53;
  static constexpr double kSlack = 1 + 0x1p-50;
  static constexpr double kLeastResult = 0x1p-720;
  static_assert((kSlack - 1) * kUnit * kLeastResult > 16 * 0x1p-1074);

  FORCESHADE_INLINE static DoubleWithError exactly(double value) noexcept { return {value, 0}; }
  FORCESHADE_INLINE static DoubleWithError rounded(double value, double propagated) noexcept {
    return {value, kSlack * (propagated + kUnit * __builtin_fabs(value))};
  }

  FORCESHADE_INLINE DoubleWithError operator-() const noexcept { return {-value, error}; }
  FORCESHADE_INLINE friend DoubleWithError operator+(const DoubleWithError& a, const DoubleWithError& b) noexcept {
    return rounded(a.value + b.value, a.error + b.error);
  }
  FORCESHADE_INLINE friend DoubleWithError operator-(const DoubleWithError& a, const DoubleWithError& b) noexcept {
    return a + (-b);
  }
  FORCESHADE_INLINE friend DoubleWithError operator*(const DoubleWithError& a, const DoubleWithError& b) noexcept {
    return rounded(a.value * b.value,
                   __builtin_fabs(a.value) * b.error + (__builtin_fabs(b.value) * a.error + a.error * b.error));
  }
  // A divisor that may be zero gives an infinite error, not a trap.
  FORCESHADE_INLINE friend DoubleWithError operator/(const DoubleWithError& a, const DoubleWithError& b) noexcept {
    const double size = __builtin_fabs(b.value) - b.error;
    if (!(size > 0)) return {0, HUGE_VAL};
    const double quotient = a.value / b.value;
    return rounded(quotient, (a.error + __builtin_fabs(quotient) * b.error) / size);
  }
  FORCESHADE_INLINE friend DoubleWithError square_root(const DoubleWithError& a) noexcept {
    if (!(a.value > a.error)) return {0, a.value == 0 && a.error == 0 ? 0 : HUGE_VAL};
    const double root = __builtin_sqrt(a.value);
    return rounded(root, a.error / root);
  }

  FORCESHADE_INLINE friend Sign sign(const DoubleWithError& a) noexcept {
    if (__builtin_fabs(a.value) > a.error) return a.value > 0 ? Sign::positive : Sign::negative;
    return a.value == 0 && a.error == 0 ? Sign::zero : Sign::unknown;
  }
  FORCESHADE_INLINE friend DoubleWithError widened(const DoubleWithError& a, int k) noexcept {
    return {a.value, std::ldexp(__builtin_fabs(a.value), k)};
  }
};

// The same as the general one: both ends of the enclosure round to the answer. 2^-52 covers the rounding of the ends
// themselves.
FORCESHADE_INLINE std::optional<float> round_to_binary32(const DoubleWithError& a) noexcept {
  const double reach = a.error == 0 ? 0 : a.error + 0x1p-52 * __builtin_fabs(a.value);
  const auto low = static_cast<float>(a.value - reach), high = static_cast<float>(a.value + reach);
  if (!(low == high)) return std::nullopt;
  return low + 0.0F;  // -0 becomes +0
}

}  // namespace forceshade::fast
