// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers of binary64 that know how far they may be off, for what intervals decide where these leave a doubt.

#include <algorithm>
#include <cmath>

namespace forceshade::mesh {

// The bound of the relative error of the C library's atan and cos: 8 units in the last place, of which glibc documents 1.
inline constexpr double kLibraryError = 0x1p-50;

// A binary64 number with a bound of its error: that of a rounding, 2^-53 of the result, and those handed on. The factor covers
// the bound's own roundings. No product of a mesh's lengths is so small that it would be subnormal.
struct BoundedNumber {
  double value = 0, error = 0;

  static BoundedNumber rounded(double value, double propagated) {
    return {value, (1 + 0x1p-50) * (propagated + 0x1p-53 * std::fabs(value))};
  }
  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    return rounded(a.value * b.value, std::fabs(a.value) * b.error + (std::fabs(b.value) * a.error + a.error * b.error));
  }
  friend BoundedNumber operator/(const BoundedNumber& a, const BoundedNumber& b) {
    const double least = std::fabs(b.value) - b.error;
    if (!(least > 0)) return {0, HUGE_VAL};
    const double quotient = a.value / b.value;
    return rounded(quotient, (a.error + std::fabs(quotient) * b.error) / least);
  }
  friend BoundedNumber sqrt(const BoundedNumber& a) {
    if (!(a.value > a.error)) return {0, HUGE_VAL};
    const double root = std::sqrt(a.value);
    return rounded(root, a.error / root);
  }

  friend BoundedNumber atan(const BoundedNumber& a) {
    const double arc = std::atan(a.value), least = std::max(0.0, std::fabs(a.value) - a.error);
    return rounded(arc, (1 + 0x1p-30) * a.error / (1 + least * least) + kLibraryError * std::fabs(arc));
  }

  // The binary32 numbers nearest to the ends.
  float nearest_to_low() const { return static_cast<float>(value - reach()); }
  float nearest_to_high() const { return static_cast<float>(value + reach()); }

 private:
  double reach() const { return error + 0x1p-52 * std::fabs(value); }
};

inline BoundedNumber in_binary64(float number) {
  return {static_cast<double>(number), 0};
}

}  // namespace forceshade::mesh
