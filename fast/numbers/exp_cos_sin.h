// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// exp(-q), and cosine and sine, in Ball arithmetic: the argument halved until a few terms of the series do, the result squared
// as often. No constant, no library function: the bounds are those of sums and products, which double with each squaring.

#include <cmath>
#include <type_traits>

#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/double_double.h"
#include "fast/numbers/double_with_error.h"

namespace forceshade::fast {

// The argument is brought below 2^-kBits, where kTerms terms leave less than 2^-(kBits·kTerms).
template <class N>
struct SeriesSize {
  static constexpr int kBits = 9, kTerms = 12;  // double-double: 2^-108
};
template <>
struct SeriesSize<DoubleWithError> {
  static constexpr int kBits = 6, kTerms = 10;  // 2^-60
};
template <std::size_t kLimbs>
struct SeriesSize<BigFloatBall<kLimbs>> {
  static constexpr int kBits = 64, kTerms = static_cast<int>(kLimbs) + 1;
};

// 0 give or take 2^-exponent.
template <class N>
N within(int exponent) noexcept {
  constexpr int kStep = 512;  // binary64 holds 2^-kStep
  N size = N::exactly(1);
  for (; exponent > kStep; exponent -= kStep) size = size * N::exactly(std::ldexp(1.0, -kStep));
  size = size * N::exactly(std::ldexp(1.0, -exponent));
  return widened(size, 1) - size;
}

// Σ wⁱ first!/(first + i·step)! over i >= 0, for -2^-(kBits·step) <= w <= 0: the terms alternate and fall, so what is left out
// is smaller than the first of it. As one quotient: a Ball divides slowly.
template <class N>
N factorial_series(const N& w, int first, int step) noexcept {
  using Size = SeriesSize<N>;
  const int terms = (Size::kTerms + step - 1) / step;
  N numerator = N::exactly(1), denominator = N::exactly(1);
  for (int i = terms - 1; i > 0; --i) {
    for (int m = 0; m < step; ++m) denominator = denominator * N::exactly(first + i * step - m);
    numerator = denominator + w * numerator;
  }
  return numerator / denominator + within<N>(Size::kBits * Size::kTerms);
}

// The halvings for a number below `size`; 0 < size. Once more than its exponent takes: a number may be rounded up to `size`.
template <class N>
int halvings(double size) noexcept {
  const int k = std::ilogb(size) + 2 + SeriesSize<N>::kBits;
  return k > 0 ? k : 0;
}

// exp(-q) for 0 <= q <= size, 0 < size. Below 2^-400 binary64 would soon be subnormal, and its Balls say no more than that.
template <class N>
N exp_of_minus(const N& q, double size) noexcept {
  constexpr bool kIsBinary64 = std::is_same_v<N, DoubleWithError> || std::is_same_v<N, DoubleDouble>;
  if constexpr (kIsBinary64) {
    constexpr double kFar = 300;  // exp(-300) is below 2^-432
    if (sign_of_difference(q, kFar) != Sign::negative) return widened(N::exactly(0x1p-400), 0);
  }
  const int k = halvings<N>(size);
  N result = factorial_series(-(q * N::exactly(std::ldexp(1.0, -k))), 0, 1);
  for (int i = 0; i < k; ++i) result = result * result;
  return result;
}

template <class N>
struct CosineAndSine {
  N cosine, sine;
};

// Requires |angle| <= size and 0 < size.
template <class N>
CosineAndSine<N> cosine_and_sine(const N& angle, double size) noexcept {
  const int k = halvings<N>(size);
  const N part = angle * N::exactly(std::ldexp(1.0, -k)), w = -(part * part);
  N cosine = factorial_series(w, 0, 2), sine = part * factorial_series(w, 1, 2);
  for (int i = 0; i < k; ++i) {
    const N product = cosine * sine;
    cosine = cosine * cosine - sine * sine;
    sine = product + product;
  }
  return {cosine, sine};
}

}  // namespace forceshade::fast
