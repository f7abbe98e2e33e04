// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact rational numbers of bounded size: the last word on height maps, where an enclosure cannot distinguish a tie from what
// is beside it. No error bound is needed: a number is held without rounding, or says that it is not.

#include "fast/numbers/big_float_ball.h"

namespace forceshade::fast {

// Numerator and denominator have kMostBits at most. A fraction that would need more, or whose divisor was 0, is not exact, and
// so is whatever is computed from it; the sign of such a fraction is unknown.
class Fraction {
 public:
  static constexpr std::size_t kMostBits = 12288;
  using Integer = BigFloatBall<kMostBits / 64>;  // times a power of two

  Fraction() noexcept = default;
  static Fraction exactly(double value) noexcept { return whole(Integer::exactly(value)); }
  static Fraction whole(const Integer& value) noexcept { return Fraction(value, Integer::exactly(1)); }

  Fraction operator-() const noexcept {
    Fraction result = *this;
    result.numerator_ = -result.numerator_;
    return result;
  }
  // Equal denominators stay: the weights of a spline share theirs.
  friend Fraction operator+(const Fraction& a, const Fraction& b) noexcept {
    if (a.is_zero()) return b;
    if (b.is_zero()) return a;
    if (a.is_exact() && b.is_exact() && a.denominator_ == b.denominator_)
      return Fraction(a.numerator_ + b.numerator_, a.denominator_);
    return Fraction(a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_, a.denominator_ * b.denominator_);
  }
  friend Fraction operator-(const Fraction& a, const Fraction& b) noexcept { return a + -b; }
  friend Fraction operator*(const Fraction& a, const Fraction& b) noexcept {
    if (!a.is_exact() || !b.is_exact()) return not_exact();
    return Fraction(a.numerator_ * b.numerator_, a.denominator_ * b.denominator_);
  }
  friend Fraction operator/(const Fraction& a, const Fraction& b) noexcept {
    switch (sign(b)) {
      case Sign::positive: return a * Fraction(b.denominator_, b.numerator_);
      case Sign::negative: return a * Fraction(-b.denominator_, -b.numerator_);
      default: return not_exact();
    }
  }
  friend Sign sign(const Fraction& a) noexcept { return a.is_exact() ? sign(a.numerator_) : Sign::unknown; }

  bool is_exact() const noexcept { return numerator_.is_exact() && denominator_.is_exact(); }
  bool is_zero() const noexcept { return sign(*this) == Sign::zero; }
  bool is_whole() const noexcept { return is_exact() && denominator_ == Integer::exactly(1); }
  const Integer& numerator() const noexcept { return numerator_; }
  const Integer& denominator() const noexcept { return denominator_; }

 private:
  static Fraction not_exact() noexcept { return whole(widened(Integer::exactly(1), 0)); }
  // The denominator: positive; brought to [1, 2), so that one which is a power of two is 1.
  Fraction(const Integer& numerator, const Integer& denominator) noexcept : numerator_(numerator), denominator_(denominator) {
    if (is_exact() && sign(numerator_) == Sign::zero) {
      denominator_ = Integer::exactly(1);
      return;
    }
    const std::int64_t shift = 1 - denominator_.exponent();
    numerator_ = numerator_.scaled(shift);
    denominator_ = denominator_.scaled(shift);
  }

  Integer numerator_, denominator_ = Integer::exactly(1);
};

// An enclosure of it.
template <class N>
N enclosed(const Fraction& a) noexcept {
  return N(a.numerator()) / N(a.denominator());
}

}  // namespace forceshade::fast
