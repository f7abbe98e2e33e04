// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A function over a whole stretch of its variable: a cubic with a bound on all that it leaves out. The laws' own formulas,
// evaluated once on this number, answer for every position of a run (run.h).

#include <array>
#include <cmath>
#include <limits>

#include "reference/numbers/ball64.h"

namespace forceshade::reference {

// |f(s) - (c0 + c1·s + c2·s² + c3·s³)| <= rest for all s in [-1, 1].
class Taylor {
 public:
  Taylor(double constant = 0) : c_{constant, 0, 0, 0} {}
  explicit Taylor(const Ball64& constant) : c_{constant.mid(), 0, 0, 0}, rest_(constant.rad()) {}

  // mid + reach·s, exactly.
  static Taylor variable(double mid, double reach) {
    Taylor t(mid);
    t.c_[1] = reach;
    return t;
  }

  long double coefficient(std::size_t k) const { return c_[k]; }
  long double rest() const { return rest_; }

  friend Taylor operator-(const Taylor& a) {
    Taylor t;
    for (std::size_t k = 0; k < 4; ++k) t.c_[k] = -a.c_[k];
    t.rest_ = a.rest_;
    return t;
  }

  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    Taylor t;
    for (std::size_t k = 0; k < 4; ++k) t.c_[k] = a.c_[k] + b.c_[k];
    return t.with_rest(a.rest_ + b.rest_ + kUnit * t.size());
  }

  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + (-b); }

  // Seven coefficients, of which the last three go into the rest.
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor t;
    long double dropped = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (i + k < 4)
          t.c_[i + k] += a.c_[i] * b.c_[k];
        else
          dropped += std::fabs(a.c_[i] * b.c_[k]);
      }
    }
    // Each coefficient is a sum of at most four products.
    return t.with_rest(dropped + 5 * kUnit * a.size() * b.size() + a.size() * b.rest_ + a.rest_ * (b.size() + b.rest_));
  }

  // The quotient uses, for b = b0(1 + u), |u| <= U: 1/(1 + u) = 1 - u + u² - u³ within U⁴/(1 - U).
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    const Taylor u = b.relative_change();
    const long double U = u.size() + u.rest_;
    const Taylor one(1.0);
    Taylor inverse = one - u * (one - u * (one - u));
    inverse.rest_ += kSlack * U * U * U * U / (1 - U);
    return (a * inverse).over(b.c_[0]);
  }

  // √(1 + u) = 1 + u/2 - u²/8 + u³/16 within (5/128)·U⁴/(1 - U): its coefficients only get smaller.
  friend Taylor sqrt(const Taylor& a) {
    if (a.c_[0] == 0 && a.size() + a.rest_ == 0) return a;
    if (!(a.c_[0] > 0)) throw Undecided{};
    const Taylor u = a.relative_change();
    const long double U = u.size() + u.rest_;
    Taylor root = Taylor(1.0) + u * (Taylor(0.5) - u * (Taylor(0.125) - u * Taylor(0.0625)));
    root.rest_ += kSlack * 5 * U * U * U * U / (128 * (1 - U));
    const long double scale = std::sqrt(a.c_[0]);
    return root * Taylor(Ball64(scale, kUnit * scale));
  }

  // The answer holds for every s; throws Undecided where it differs.
  friend bool operator<(const Taylor& a, const Taylor& b) {
    const Taylor difference = a - b;
    const long double spread = kSlack * (difference.size() - std::fabs(difference.c_[0]) + difference.rest_);
    if (difference.c_[0] < -spread) return true;
    if (difference.c_[0] >= spread) return false;
    throw Undecided{};
  }
  friend bool operator>(const Taylor& a, const Taylor& b) { return b < a; }
  friend bool operator<=(const Taylor& a, const Taylor& b) { return !(b < a); }

 private:
  // Twice the unit roundoff of long double.
  static constexpr long double kUnit = std::numeric_limits<long double>::epsilon();
  // Covers the rounding of the few positive sums and products that make a bound.
  static constexpr long double kSlack = 1 + 0x1p-50L;

  long double size() const { return std::fabs(c_[0]) + std::fabs(c_[1]) + std::fabs(c_[2]) + std::fabs(c_[3]); }

  Taylor with_rest(long double rest) const {
    Taylor t = *this;
    t.rest_ = kSlack * rest;
    return t;
  }

  Taylor over(long double divisor) const {
    Taylor t;
    for (std::size_t k = 0; k < 4; ++k) t.c_[k] = c_[k] / divisor;
    return t.with_rest(rest_ / std::fabs(divisor) + kUnit * t.size());
  }

  // This over its first coefficient, less 1; a series in it is of use only while it is small.
  Taylor relative_change() const {
    if (c_[0] == 0) throw Undecided{};
    Taylor u = *this;
    u.c_[0] = 0;
    u = u.over(c_[0]);
    if (!(u.size() + u.rest_ <= 0.25L)) throw Undecided{};
    return u;
  }

  std::array<long double, 4> c_{};
  long double rest_ = 0;
};

}  // namespace forceshade::reference
