// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A number that writes down what is done with it: the templates of fast/ run on it as they stand (a Real in the sense of
// fast/numbers/first_stage.h). Comparisons are decided by an ordinary binary64 number beside the expression, so that one run
// follows one branch.

#include <array>
#include <cmath>

#include "fast/numbers/first_stage.h"
#include "tests/fast/expressions.h"

namespace forceshade::tests {

struct Comparison {
  Scaled left, right;
};

// The place that all numbers of one run write to; one at a time.
class Recording {
 public:
  // is_fused: multiply_add and multiply_subtract are one operation, as with AVX2 and AVX-512, else two.
  Recording(Expressions& to, bool is_fused) : expressions(to), fuses(is_fused) { current_ = this; }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording() { current_ = nullptr; }

  static Recording& current() { return *current_; }

  Expressions& expressions;
  const bool fuses;
  std::vector<Comparison> comparisons;

 private:
  static inline Recording* current_ = nullptr;
};

class Recorded {
 public:
  struct Mask {
    bool holds = false;
    friend Mask operator&(Mask a, Mask b) { return {a.holds && b.holds}; }
    friend Mask operator|(Mask a, Mask b) { return {a.holds || b.holds}; }
    friend Mask operator!(Mask a) { return {!a.holds}; }
  };

  Recorded() : Recorded(0.0) {}
  explicit Recorded(double constant) : value_(constant), expression_(all().constant(constant)) {}
  Recorded(double value, const Scaled& expression) : value_(value), expression_(expression) {}

  double value() const { return value_; }
  const Scaled& expression() const { return expression_; }

  friend Recorded operator-(const Recorded& a) { return {-a.value_, -a.expression_}; }
  friend Recorded operator+(const Recorded& a, const Recorded& b) {
    return rounded(a.value_ + b.value_, all().sum(a.expression_, b.expression_));
  }
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return a + (-b); }
  friend Recorded operator*(const Recorded& a, const Recorded& b) {
    return rounded(a.value_ * b.value_, all().product(a.expression_, b.expression_));
  }
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    return rounded(a.value_ / b.value_, all().quotient(a.expression_, b.expression_));
  }
  friend Recorded square_root(const Recorded& a) { return rounded(std::sqrt(a.value_), all().square_root(a.expression_)); }
  friend Recorded fused(const Recorded& a, const Recorded& b, const Recorded& c) {
    return {std::fma(a.value_, b.value_, c.value_), all().fused(a.expression_, b.expression_, c.expression_)};
  }
  friend Recorded multiply_add(const Recorded& a, const Recorded& b, const Recorded& c) {
    return Recording::current().fuses ? fused(a, b, c) : a * b + c;
  }
  friend Recorded multiply_subtract(const Recorded& a, const Recorded& b, const Recorded& c) {
    return Recording::current().fuses ? fused(-a, b, c) : c - a * b;
  }
  friend Recorded absolute(const Recorded& a) { return a.value_ < 0 ? -a : a; }
  friend Recorded larger(const Recorded& a, const Recorded& b) { return a.value_ > b.value_ ? a : b; }
  friend Recorded select(Mask condition, const Recorded& yes, const Recorded& no) { return condition.holds ? yes : no; }

  friend Mask operator<(const Recorded& a, const Recorded& b) { return compared(a, b, a.value_ < b.value_); }
  friend Mask operator<=(const Recorded& a, const Recorded& b) { return compared(a, b, a.value_ <= b.value_); }
  friend Mask operator>(const Recorded& a, const Recorded& b) { return compared(a, b, a.value_ > b.value_); }
  friend Mask operator>=(const Recorded& a, const Recorded& b) { return compared(a, b, a.value_ >= b.value_); }
  friend Mask operator==(const Recorded& a, const Recorded& b) { return compared(a, b, a.value_ == b.value_); }

 private:
  static Expressions& all() { return Recording::current().expressions; }
  static Recorded rounded(double value, const Scaled& exact) { return {value, all().rounded(exact)}; }
  static Mask compared(const Recorded& a, const Recorded& b, bool holds) {
    Recording::current().comparisons.push_back({a.expression_, b.expression_});
    return {holds};
  }

  double value_;
  Scaled expression_;
};

}  // namespace forceshade::tests
