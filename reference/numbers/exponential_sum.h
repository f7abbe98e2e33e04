// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact numbers for height maps: finite sums of c·√D·e^(-b)·cos(a) and c·√D·e^(-b)·sin(a), with c, b, a rational, b and a not
// negative, and D a positive integer.
//
// The height and the slopes of every kind of map are such numbers, and polynomials of such numbers are such numbers. Whether
// one is 0 can be read off: by the theorem of Lindemann and Weierstrass, exponentials of different algebraic numbers are
// linearly independent over the algebraic numbers, and square roots of integers of which no two have a square as their product
// are linearly independent over the rationals (Besicovitch 1940). So a sum whose like terms have been collected is 0 only if it
// has no term. The sign of any other sum is found by enclosing it more and more narrowly, which must come to an end.
//
// A.Baker, Transcendental Number Theory, chapter 1. Callers hold exact_arithmetic.

#include <boost/multiprecision/gmp.hpp>
#include <vector>

#include "reference/numbers/multiprecision.h"

namespace forceshade::reference {

class ExponentialSum {
 public:
  using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
  using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

  ExponentialSum(double exact = 0) : ExponentialSum(Rational(exact)) {}
  explicit ExponentialSum(const Rational& value) { add({value}); }

  ExponentialSum operator-() const;
  friend ExponentialSum operator+(const ExponentialSum& a, const ExponentialSum& b);
  friend ExponentialSum operator-(const ExponentialSum& a, const ExponentialSum& b) { return a + -b; }
  friend ExponentialSum operator*(const ExponentialSum& a, const ExponentialSum& b);
  // The divisor: one term c·√D, not 0. Throws std::logic_error for any other.
  friend ExponentialSum operator/(const ExponentialSum& a, const ExponentialSum& b);

  // Root and exponential of a rational number, which is not negative for the root. They throw std::logic_error for any other
  // sum.
  friend ExponentialSum sqrt(const ExponentialSum& a);
  friend ExponentialSum exp(const ExponentialSum& a);  // of a number that is not positive
  friend ExponentialSum cos(const ExponentialSum& a);
  friend ExponentialSum sin(const ExponentialSum& a);

  // -1, 0 or 1, exactly.
  int sign() const;

 private:
  struct Term {
    Rational factor;  // c, not 0
    Integer radicand = 1;
    Rational decay = 0, angle = 0;  // b, a
    bool is_sine = false;           // then the angle is not 0
  };

  // Collects like terms.
  void add(Term term);
  Rational as_rational() const;
  Enclosure enclosure(const Rational& least_decay) const;

  std::vector<Term> terms_;
};

}  // namespace forceshade::reference
