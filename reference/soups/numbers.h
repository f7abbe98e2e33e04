// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rational numbers and vectors of them, for a definition that is meant to be read.

#include <boost/multiprecision/gmp.hpp>

#include "reference/meshes/integers.h"

namespace forceshade::reference::soups {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
using Whole = meshes::Integer;

struct Vector {
  Rational x, y, z;

  bool operator==(const Vector&) const = default;
};

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator-(const Vector& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vector operator*(const Rational& t, const Vector& a) {
  return {t * a.x, t * a.y, t * a.z};
}
inline Rational dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Rational squared(const Vector& a) {
  return dot(a, a);
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline bool is_zero(const Vector& a) {
  return a.x.is_zero() && a.y.is_zero() && a.z.is_zero();
}
inline bool are_parallel(const Vector& a, const Vector& b) {
  return is_zero(cross(a, b));
}
// True for parallel vectors that point the same way.
inline bool same_direction(const Vector& a, const Vector& b) {
  return are_parallel(a, b) && dot(a, b) > 0;
}
// The part of a at a right angle to b.
inline Vector across(const Vector& a, const Vector& b) {
  return a - dot(a, b) / squared(b) * b;
}
// s·|s|, which orders numbers as s = a·b/‖b‖ does.
inline Rational signed_square_along(const Vector& a, const Vector& b) {
  const Rational s = dot(a, b);
  return s * abs(s) / squared(b);
}
inline Whole floor(const Rational& value) {
  const Whole over(numerator(value)), under(denominator(value));
  Whole quotient = over / under;
  if (quotient * under > over) --quotient;
  return quotient;
}
inline bool is_whole(const Rational& value) {
  return denominator(value) == 1;
}
// The nearest whole number, ties to even.
inline Whole nearest(const Rational& value) {
  const Whole below = floor(value);
  const Rational rest = value - Rational(below), half(1, 2);
  return rest > half || (rest == half && bit_test(below < 0 ? Whole(-below) : below, 0)) ? Whole(below + 1) : below;
}

}  // namespace forceshade::reference::soups
