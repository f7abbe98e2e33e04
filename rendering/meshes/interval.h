// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An interval with ends of any precision, by MPFI: every result encloses the exact one.

#include <mpfi.h>

namespace forceshade::mesh {

class Interval {
 public:
  // 0, in so many bits; every result of an operation has the bits of its left operand.
  explicit Interval(mpfr_prec_t bits) {
    mpfi_init2(value_, bits);
    mpfi_set_si(value_, 0);
  }
  Interval(mpfr_prec_t bits, double exact) : Interval(bits) { mpfi_set_d(value_, exact); }
  Interval(const Interval& other) : Interval(other.bits()) { mpfi_set(value_, other.value_); }
  Interval& operator=(const Interval& other) {
    if (this != &other) mpfi_set(value_, other.value_);
    return *this;
  }
  ~Interval() { mpfi_clear(value_); }

  mpfr_prec_t bits() const { return mpfi_get_prec(value_); }

  friend Interval operator+(const Interval& a, const Interval& b) { return by(&mpfi_add, a, b); }
  friend Interval operator-(const Interval& a, const Interval& b) { return by(&mpfi_sub, a, b); }
  friend Interval operator*(const Interval& a, const Interval& b) { return by(&mpfi_mul, a, b); }
  friend Interval operator/(const Interval& a, const Interval& b) { return by(&mpfi_div, a, b); }
  friend Interval sqrt(const Interval& a) { return by(&mpfi_sqrt, a); }
  friend Interval atan(const Interval& a) { return by(&mpfi_atan, a); }
  friend Interval cos(const Interval& a) { return by(&mpfi_cos, a); }
  static Interval pi(mpfr_prec_t bits) {
    Interval result(bits);
    mpfi_const_pi(result.value_);
    return result;
  }

  bool has_zero() const { return mpfi_has_zero(value_) != 0; }
  // Whether every number of the one is below every number of the other.
  friend bool is_below(const Interval& a, const Interval& b) { return mpfr_less_p(&a.value_->right, &b.value_->left) != 0; }
  // The binary32 numbers nearest to the ends.
  float nearest_to_low() const { return mpfr_get_flt(&value_->left, MPFR_RNDN); }
  float nearest_to_high() const { return mpfr_get_flt(&value_->right, MPFR_RNDN); }

 private:
  template <class Operation>
  static Interval by(const Operation& operation, const Interval& a, const Interval& b) {
    Interval result(a.bits());
    operation(result.value_, a.value_, b.value_);
    return result;
  }
  template <class Operation>
  static Interval by(const Operation& operation, const Interval& a) {
    Interval result(a.bits());
    operation(result.value_, a.value_);
    return result;
  }

  mpfi_t value_;
};

}  // namespace forceshade::mesh
