// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A number that carries a bound of its own rounding error: the laws' first stages run on it as they stand.
//
// It stands for all numbers that one step of the computation can meet over a box of inputs. [low, high] encloses the exact
// value; the computed one differs from it by at most error(). Rounding adds 2^-53 of the largest size, or nothing where the
// result is a multiple of a power of two coarse enough to be a binary64 number. The errors are kept apart term by term, so
// that a rounding error found by subtraction cancels the one in the sum it is added to.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "fast/numbers/first_stage.h"

namespace forceshade::tests {

class ErrorNumber {
 public:
  // The possible results of a comparison over the box.
  struct Mask {
    bool can_hold = false, can_fail = true;
    bool certain() const { return can_hold && !can_fail; }
    friend Mask operator&(Mask a, Mask b) { return {a.can_hold && b.can_hold, a.can_fail || b.can_fail}; }
    friend Mask operator|(Mask a, Mask b) { return {a.can_hold || b.can_hold, a.can_fail && b.can_fail}; }
    friend Mask operator!(Mask a) { return {a.can_fail, a.can_hold}; }
  };

  // A constant of the law: exact, or off by what declare() was told of a constant of this size.
  explicit ErrorNumber(double constant) : low_(constant), high_(constant), quantum_(lowest_bit(constant)) {
    const auto declared = declarations().find(std::fabs(constant));
    if (declared == declarations().end()) return;
    add_term(declared->second);
    low_ -= Exact{declared->second};
    high_ += Exact{declared->second};
  }

  // Any binary32 number from a to b, both of one sign.
  static ErrorNumber between(float a, float b) {
    ErrorNumber result(0.0);
    result.low_ = static_cast<Exact>(std::min(a, b));
    result.high_ = static_cast<Exact>(std::max(a, b));
    const Exact least = result.least_size();
    result.quantum_ = a == b ? lowest_bit(static_cast<double>(a)) : least > 0 ? std::ilogb(least) - 23 : -149;
    return result;
  }

  // From now on a constant of this size stands for a number up to `error` away.
  static void declare(double constant, double error) {
    if (constant != 0) declarations()[std::fabs(constant)] = error;
  }
  static void declare_nothing() { declarations().clear(); }

  double error() const {
    double sum = 0;
    for (const auto& [id, size] : terms_) sum += std::fabs(size);
    return sum * kSlack;
  }
  // The largest relative error; zero has none.
  double relative_error() const { return error() == 0 ? 0 : static_cast<double>(Exact{error()} / least_size()); }
  // Returns true if all exact values are of one size, to 2^-7: relative_error() overstates where they are not.
  bool narrow() const { return (low_ == 0 && high_ == 0) || largest_size() <= (1 + 0x1p-7) * least_size(); }

  friend ErrorNumber operator-(ErrorNumber a) {
    std::swap(a.low_, a.high_);
    a.low_ = -a.low_;
    a.high_ = -a.high_;
    for (auto& [id, size] : a.terms_) size = -size;
    return a;
  }
  friend ErrorNumber operator+(const ErrorNumber& a, const ErrorNumber& b) {
    if (&a == &b) return doubled(a);
    return rounded(unrounded_sum(a, b));
  }
  friend ErrorNumber operator-(const ErrorNumber& a, const ErrorNumber& b) { return a + (-b); }
  friend ErrorNumber operator*(const ErrorNumber& a, const ErrorNumber& b) {
    const Exact ends[] = {a.low_ * b.low_, a.low_ * b.high_, a.high_ * b.low_, a.high_ * b.high_};
    ErrorNumber result = enclosing(*std::min_element(ends, ends + 4), *std::max_element(ends, ends + 4));
    const Exact ea = a.error(), eb = b.error();
    result.add_term(a.largest_size() * eb + b.largest_size() * ea + ea * eb);
    result.quantum_ = a.quantum_ + b.quantum_;
    return rounded(std::move(result));
  }
  friend ErrorNumber operator/(const ErrorNumber& a, const ErrorNumber& b) {
    const Exact least = b.least_size() - Exact{b.error()};
    if (!(least > 0)) return unknown();
    const Exact ends[] = {a.low_ / b.low_, a.low_ / b.high_, a.high_ / b.low_, a.high_ / b.high_};
    ErrorNumber result = enclosing(*std::min_element(ends, ends + 4), *std::max_element(ends, ends + 4));
    result.add_term((Exact{a.error()} + result.largest_size() * Exact{b.error()}) / least);
    return rounded(std::move(result));
  }
  friend ErrorNumber square_root(const ErrorNumber& a) {
    const Exact e = a.error();
    if (a.low_ - e < 0) return unknown();
    ErrorNumber result = enclosing(std::sqrt(a.low_), std::sqrt(a.high_));
    if (e > 0) result.add_term(e / (std::sqrt(a.low_) + std::sqrt(a.low_ - e)));
    return rounded(std::move(result));
  }
  friend ErrorNumber absolute(const ErrorNumber& a) {
    if (a.low_ >= 0) return a;
    if (a.high_ <= 0) return -a;
    ErrorNumber result = a;
    result.low_ = 0;
    result.high_ = a.largest_size();
    result.terms_.clear();
    result.add_term(a.error());
    return result;
  }
  friend ErrorNumber select(Mask condition, const ErrorNumber& yes, const ErrorNumber& no) {
    if (!condition.can_fail) return yes;
    if (!condition.can_hold) return no;
    ErrorNumber result = yes;
    result.low_ = std::min(yes.low_, no.low_);
    result.high_ = std::max(yes.high_, no.high_);
    result.terms_.clear();
    result.add_term(std::max(yes.error(), no.error()));
    result.quantum_ = std::min(yes.quantum_, no.quantum_);
    return result;
  }
  friend ErrorNumber larger(const ErrorNumber& a, const ErrorNumber& b) { return select(a > b, a, b); }
  friend ErrorNumber multiply_add(const ErrorNumber& a, const ErrorNumber& b, const ErrorNumber& c) { return a * b + c; }
  friend ErrorNumber multiply_subtract(const ErrorNumber& a, const ErrorNumber& b, const ErrorNumber& c) { return c - a * b; }
  // Comparisons are between the computed numbers.
  friend Mask operator<(const ErrorNumber& a, const ErrorNumber& b) {
    return {a.least() < b.greatest(), a.greatest() >= b.least()};
  }
  friend Mask operator<=(const ErrorNumber& a, const ErrorNumber& b) {
    return {a.least() <= b.greatest(), a.greatest() > b.least()};
  }
  friend Mask operator>(const ErrorNumber& a, const ErrorNumber& b) { return b < a; }
  friend Mask operator>=(const ErrorNumber& a, const ErrorNumber& b) { return b <= a; }
  friend Mask operator==(const ErrorNumber& a, const ErrorNumber& b) {
    const bool may_be = a.least() <= b.greatest() && a.greatest() >= b.least();
    return {may_be, !may_be || a.least() != a.greatest() || b.least() != b.greatest()};
  }

 private:
  using Exact = long double;  // fine enough that enclosing the exact values costs next to nothing

  static constexpr double kSlack = 1 + 0x1p-40;  // for the rounding of the bounds themselves
  static constexpr Exact kUnit = 0x1p-53L;

  static std::map<double, double>& declarations() {
    static std::map<double, double> all;
    return all;
  }
  // The largest k for which 2^k divides a.
  static int lowest_bit(double a) {
    if (a == 0) return 1000;
    int exponent = 0;
    auto whole = static_cast<long long>(std::ldexp(std::frexp(a, &exponent), 53));
    int k = exponent - 53;
    for (; whole % 2 == 0; whole /= 2) ++k;
    return k;
  }
  static ErrorNumber unknown() {
    ErrorNumber result(0.0);
    result.low_ = -HUGE_VALL;
    result.high_ = HUGE_VALL;
    result.add_term(HUGE_VALL);
    return result;
  }
  static ErrorNumber enclosing(Exact low, Exact high) {
    ErrorNumber result(0.0);
    result.low_ = low == 0 ? 0 : std::nextafter(low, -HUGE_VALL);
    result.high_ = high == 0 ? 0 : std::nextafter(high, HUGE_VALL);
    result.quantum_ = -2000;
    return result;
  }
  static ErrorNumber doubled(ErrorNumber a) {
    a.low_ *= 2;
    a.high_ *= 2;
    for (auto& [id, size] : a.terms_) size *= 2;
    ++a.quantum_;
    return a;
  }
  static ErrorNumber unrounded_sum(const ErrorNumber& a, const ErrorNumber& b) {
    ErrorNumber result = enclosing(a.low_ + b.low_, a.high_ + b.high_);
    result.terms_ = a.terms_;
    for (const auto& [id, size] : b.terms_)
      if ((result.terms_[id] += size) == 0) result.terms_.erase(id);
    result.quantum_ = std::min(a.quantum_, b.quantum_);
    return result;
  }
  // Computed numbers that are multiples of 2^quantum and at most 2^(quantum + 53) are binary64 numbers already.
  static ErrorNumber rounded(ErrorNumber a) {
    const Exact most = a.largest_size() + Exact{a.error()};
    if (most > std::ldexp(Exact{1}, a.quantum_ + 53)) a.add_term(kUnit * most);
    const Exact least = a.least_size() - Exact{a.error()};
    if (least > 0 && least < HUGE_VALL) a.quantum_ = std::max(a.quantum_, std::ilogb(least) - 52);
    return a;
  }

  void add_term(Exact size) {
    static int last = 0;
    if (size != 0) terms_[++last] = static_cast<double>(size);
  }
  Exact least_size() const { return low_ > 0 ? low_ : high_ < 0 ? -high_ : 0; }
  Exact largest_size() const { return std::max(std::fabs(low_), std::fabs(high_)); }
  Exact least() const { return low_ - Exact{error()}; }
  Exact greatest() const { return high_ + Exact{error()}; }

  Exact low_, high_;
  std::map<int, double> terms_;  // errors by their origin: the size is a bound, the sign distinguishes two uses of one error
  int quantum_;                  // the computed numbers are multiples of 2^quantum_
};

}  // namespace forceshade::tests
