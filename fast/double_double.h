// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The second stage's number: an unevaluated sum of two binary64 numbers that carries a proven bound of its own error.

#include <cmath>
#include <cstdint>

#include "forceshade/fast/ball.h"

namespace forceshade::fast {

struct TwoTerms {
  double hi, lo;
};

// hi + lo == a + b exactly (Knuth).
inline TwoTerms two_sum(double a, double b) noexcept {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

// As two_sum, for |a| >= |b| or a == 0 (Dekker).
inline TwoTerms fast_two_sum(double a, double b) noexcept {
  const double s = a + b;
  return {s, b - (s - a)};
}

// hi + lo == a * b exactly, while the product's last bit is above 2^-1074.
inline TwoTerms two_product(double a, double b) noexcept {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

// |true value - (hi + lo)| <= error. Relative errors of the operations below: sum at most 3·2^-106 and a little (Joldes,
// Muller and Popescu 2017, theorem 3.1); product, quotient and root proved in double_double.g. All are charged as 2^-101; the
// bound's own arithmetic is rounded up by the factor kSlack, of which 2^-49 would be enough.
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

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const TwoTerms s = two_sum(a.hi, b.hi);
    const TwoTerms t = two_sum(a.lo, b.lo);
    const TwoTerms v = fast_two_sum(s.hi, s.lo + t.hi);
    return rounded(fast_two_sum(v.hi, t.lo + v.lo), a.error + b.error);
  }

  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) noexcept { return a + (-b); }

  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const TwoTerms p = two_product(a.hi, b.hi);
    const double low = std::fma(a.hi, b.lo, std::fma(a.lo, b.hi, a.lo * b.lo));
    return rounded(fast_two_sum(p.hi, p.lo + low), std::fabs(a.hi) * b.error + std::fabs(b.hi) * a.error + a.error * b.error);
  }

  // A divisor that may be zero gives an infinite error, not a trap.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) noexcept {
    const double size = std::fabs(b.hi) * (1 - 0x1p-50) - b.error;
    if (!(size > 0)) return {0, 0, HUGE_VAL};
    const double quotient = a.hi / b.hi;
    const TwoTerms p = two_product(quotient, b.hi);
    const double remainder = ((a.hi - p.hi) - p.lo) + std::fma(-quotient, b.lo, a.lo);
    const TwoTerms q = fast_two_sum(quotient, remainder / b.hi);
    return rounded(q, (a.error + std::fabs(q.hi) * b.error) / size);
  }

  friend DoubleDouble square_root(const DoubleDouble& a) noexcept {
    if (a.hi == 0 && a.error == 0) return a;
    if (!(a.hi * (1 - 0x1p-50) > a.error)) return {0, 0, kSlack * std::sqrt(std::fabs(a.hi) + a.error)};
    const double root = std::sqrt(a.hi);
    const double remainder = std::fma(-root, root, a.hi) + a.lo;
    return rounded(fast_two_sum(root, remainder / (2 * root)), a.error / root);
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
