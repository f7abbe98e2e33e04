// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An interval of 192 bits, which rounds nearly all that 64 bits leave open. Its precision is part of its type, so that it needs
// no lock, unlike Enclosure. A comparison it cannot decide throws Undecided.

#include <boost/multiprecision/mpfi.hpp>

#include "reference/numbers/interval_ends.h"
#include "reference/numbers/multiprecision.h"

namespace forceshade::reference {

class Enclosure192 {
  using Interval = boost::multiprecision::number<boost::multiprecision::mpfi_float_backend<58>, boost::multiprecision::et_off>;

 public:
  Enclosure192(double exact = 0) : value_(exact) {}
  // Rounded outwards. Callers hold exact_arithmetic.
  explicit Enclosure192(const Enclosure& value) { mpfi_set(value_.backend().data(), value.backend().data()); }

  friend Enclosure192 operator-(const Enclosure192& a) { return Enclosure192(-a.value_); }
  friend Enclosure192 operator+(const Enclosure192& a, const Enclosure192& b) { return Enclosure192(a.value_ + b.value_); }
  friend Enclosure192 operator-(const Enclosure192& a, const Enclosure192& b) { return Enclosure192(a.value_ - b.value_); }
  friend Enclosure192 operator*(const Enclosure192& a, const Enclosure192& b) { return Enclosure192(a.value_ * b.value_); }
  friend Enclosure192 operator/(const Enclosure192& a, const Enclosure192& b) { return Enclosure192(a.value_ / b.value_); }
  friend Enclosure192 sqrt(const Enclosure192& a) { return Enclosure192(sqrt(a.value_)); }

  friend bool operator<(const Enclosure192& a, const Enclosure192& b) {
    if (mpfr_less_p(a.high(), b.low()) != 0) return true;
    if (mpfr_greaterequal_p(a.low(), b.high()) != 0) return false;
    throw Undecided{};
  }
  friend bool operator>(const Enclosure192& a, const Enclosure192& b) { return b < a; }
  friend bool operator<=(const Enclosure192& a, const Enclosure192& b) { return !(b < a); }

  // The binary32 both ends round to; throws Undecided when they differ.
  float round() const {
    const RoundedEnds ends(value_);
    if (!ends.agree()) throw Undecided{};
    return ends.low;
  }

  friend Ball64 to_64_bits(const Enclosure192& a) { return to_64_bits(a.value_); }

 private:
  explicit Enclosure192(Interval value) : value_(std::move(value)) {}

  mpfr_srcptr low() const { return &value_.backend().data()->left; }
  mpfr_srcptr high() const { return &value_.backend().data()->right; }

  Interval value_;
};

}  // namespace forceshade::reference
