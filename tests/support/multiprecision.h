// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Balls of the real-time side (fast/numbers/ball.h) as numbers of 1600 bits: the midpoint exactly, and the error bound.

#include <boost/multiprecision/mpfr.hpp>

#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/double_double.h"
#include "fast/numbers/double_with_error.h"

namespace forceshade::tests {

using Multiprecision =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<482>, boost::multiprecision::et_off>;

inline Multiprecision value_of(const fast::DoubleWithError& ball) {
  return ball.value;
}
inline Multiprecision value_of(const fast::DoubleDouble& ball) {
  return Multiprecision(ball.hi) + Multiprecision(ball.lo);
}
// Piece by piece: what is not larger than the rest and has 53 bits of it leaves it without rounding.
template <std::size_t kLimbs>
Multiprecision value_of(const fast::BigFloatBall<kLimbs>& ball) {
  using N = fast::BigFloatBall<kLimbs>;
  Multiprecision sum = 0;
  N rest = midpoint(ball);
  for (std::size_t piece = 0; piece < 4 * kLimbs; ++piece) {
    double head = approximately(rest);
    const double beyond = approximately(rest - N::exactly(head));
    if (head * beyond < 0) head = std::nextafter(head, 0.0);
    sum += head;
    rest = midpoint(rest - N::exactly(head));
  }
  return sum;
}

inline Multiprecision bound_of(const fast::DoubleWithError& ball) {
  return ball.error;
}
inline Multiprecision bound_of(const fast::DoubleDouble& ball) {
  return ball.error;
}
template <std::size_t kLimbs>
Multiprecision bound_of(const fast::BigFloatBall<kLimbs>& ball) {
  if (ball.is_exact()) return 0;
  return ldexp(Multiprecision(1), static_cast<long>(ball.error_exponent()));
}

}  // namespace forceshade::tests
