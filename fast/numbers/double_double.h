// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The second stage's number: an unevaluated sum of two binary64 numbers that carries a proven bound of its own error.

#include <cmath>
#include <cstdint>

#include "fast/numbers/ball.h"
#include "fast/numbers/inline.h"

namespace forceshade::fast {

// Real: binary64, or a number that writes down what is done with it (tests/fast/recorded_number.h).
template <class Real>
struct Terms {
  Real hi, lo;
};
using TwoTerms = Terms<double>;

// a·b + c, rounded once.
FORCESHADE_INLINE double fused(double a, double b, double c) noexcept {
  return std::fma(a, b, c);
}
FORCESHADE_INLINE double square_root(double a) noexcept {
  return __builtin_sqrt(a);
}

// hi + lo == a + b exactly (Knuth).
template <class Real>
FORCESHADE_INLINE Terms<Real> two_sum(Real a, Real b) noexcept {
  const Real s = a + b;
  const Real t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

// The same as two_sum, for |a| >= |b| or a == 0 (Dekker).
template <class Real>
FORCESHADE_INLINE Terms<Real> fast_two_sum(Real a, Real b) noexcept {
  const Real s = a + b;
  return {s, b - (s - a)};
}

// hi + lo == a * b exactly, while the product's last bit is above 2^-1074.
template <class Real>
FORCESHADE_INLINE Terms<Real> two_product(Real a, Real b) noexcept {
  const Real p = a * b;
  return {p, fused(a, b, -p)};
}

// The values of double-double's operations. Relative errors: sum at most 3·2^-106 and a little (Joldes, Muller and Popescu
// 2017, theorem 3.1); product, quotient and root proved in double_double.g.
template <class Real>
inline Terms<Real> sum_of(const Terms<Real>& a, const Terms<Real>& b) noexcept {
  const Terms<Real> s = two_sum(a.hi, b.hi);
  const Terms<Real> t = two_sum(a.lo, b.lo);
  const Terms<Real> v = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(v.hi, t.lo + v.lo);
}
template <class Real>
inline Terms<Real> product_of(const Terms<Real>& a, const Terms<Real>& b) noexcept {
  const Terms<Real> p = two_product(a.hi, b.hi);
  const Real low = fused(a.hi, b.lo, fused(a.lo, b.hi, a.lo * b.lo));
  return fast_two_sum(p.hi, p.lo + low);
}
template <class Real>
inline Terms<Real> quotient_of(const Terms<Real>& a, const Terms<Real>& b) noexcept {
  const Real quotient = a.hi / b.hi;
  const Terms<Real> p = two_product(quotient, b.hi);
  const Real remainder = ((a.hi - p.hi) - p.lo) + fused(-quotient, b.lo, a.lo);
  return fast_two_sum(quotient, remainder / b.hi);
}
template <class Real>
inline Terms<Real> square_root_of(const Terms<Real>& a) noexcept {
  const Real root = square_root(a.hi);
  const Real remainder = fused(-root, root, a.hi) + a.lo;
  return fast_two_sum(root, remainder / (root + root));
}

// |true value - (hi + lo)| <= error. The relative errors of all operations are charged as 2^-101; the bound's own arithmetic
// is rounded up by the factor kSlack, of which 2^-49 would be enough.
struct DoubleDouble {
  double hi = 0, lo = 0, error = 0;

  static constexpr double kRelativeError = 0x1p-101;
  static constexpr double kSlack = 1 + 0x1p-40;
  static constexpr int kNewtonSteps = 1;  // from 2^-50 past 2^-90

  static DoubleDouble exactly(double value) noexcept { return {value, 0, 0}; }

  static DoubleDouble rounded(TwoTerms value, double propagated) noexcept {
    return {value.hi, value.lo, kSlack * (propagated + kRelativeError * std::fabs(value.hi))};
  }

  DoubleDouble operator-() const noexcept { return {-hi, -lo, error}; }

  TwoTerms terms() const noexcept { return {hi, lo}; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return rounded(sum_of(a.terms(), b.terms()), a.error + b.error);
  }

  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) noexcept { return a + (-b); }

  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    return rounded(product_of(a.terms(), b.terms()), std::fabs(a.hi) * b.error + std::fabs(b.hi) * a.error + a.error * b.error);
  }

  // A divisor that may be zero gives an infinite error, not a trap.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const double size = std::fabs(b.hi) * (1 - 0x1p-50) - b.error;
    if (!(size > 0)) return {0, 0, HUGE_VAL};
    const TwoTerms q = quotient_of(a.terms(), b.terms());
    return rounded(q, (a.error + std::fabs(q.hi) * b.error) / size);
  }

  friend DoubleDouble square_root(const DoubleDouble& a) noexcept {
    if (a.hi == 0 && a.error == 0) return a;
    if (!(a.hi * (1 - 0x1p-50) > a.error)) return {0, 0, kSlack * std::sqrt(std::fabs(a.hi) + a.error)};
    const TwoTerms root = square_root_of(a.terms());
    return rounded(root, a.error / root.hi);
  }

  friend Sign sign(const DoubleDouble& a) noexcept {
    if (a.hi == 0 && a.error == 0) return Sign::zero;
    const double size = std::fabs(a.hi) * (1 - 0x1p-50);
    if (!(size > a.error)) return Sign::unknown;
    return a.hi > 0 ? Sign::positive : Sign::negative;
  }

  friend DoubleDouble midpoint(const DoubleDouble& a) noexcept { return {a.hi, a.lo, 0}; }
  friend DoubleDouble truncated(const DoubleDouble& a, std::int64_t) noexcept { return midpoint(a); }
  friend DoubleDouble widened(const DoubleDouble& a, int k) noexcept { return {a.hi, a.lo, std::ldexp(std::fabs(a.hi), k)}; }
  friend double approximately(const DoubleDouble& a) noexcept { return a.hi; }
};

}  // namespace forceshade::fast
