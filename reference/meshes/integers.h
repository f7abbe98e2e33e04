// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers that a god-object's decisions are made of: integers of any length, vectors of them, fractions that are only
// compared.

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <compare>
#include <cstddef>
#include <utility>

namespace forceshade::reference::meshes {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

inline constexpr int kFloatScale = 149;  // every finite binary32 is a multiple of 2^-149

struct Vector {
  std::array<Integer, 3> components;

  Integer& operator[](std::size_t axis) { return components[axis]; }
  const Integer& operator[](std::size_t axis) const { return components[axis]; }
  bool operator==(const Vector&) const = default;
};

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator-(const Vector& a) {
  return {-a[0], -a[1], -a[2]};
}
inline Vector operator*(const Integer& factor, const Vector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

// Products are added in place: a number more for each would take longer than the multiplication.
inline void add_product(Integer& sum, const Integer& a, const Integer& b) {
  mpz_addmul(sum.backend().data(), a.backend().data(), b.backend().data());
}
inline void subtract_product(Integer& sum, const Integer& a, const Integer& b) {
  mpz_submul(sum.backend().data(), a.backend().data(), b.backend().data());
}
inline Integer dot(const Vector& a, const Vector& b) {
  Integer sum = a[0] * b[0];
  add_product(sum, a[1], b[1]);
  add_product(sum, a[2], b[2]);
  return sum;
}
inline Vector cross(const Vector& a, const Vector& b) {
  Vector product{a[1] * b[2], a[2] * b[0], a[0] * b[1]};
  subtract_product(product[0], a[2], b[1]);
  subtract_product(product[1], a[0], b[2]);
  subtract_product(product[2], a[1], b[0]);
  return product;
}
inline bool is_zero(const Vector& a) {
  return a[0].is_zero() && a[1].is_zero() && a[2].is_zero();
}

// over / under, under > 0; not reduced.
struct Fraction {
  Integer over = 0;
  Integer under = 1;

  friend std::strong_ordering operator<=>(const Fraction& a, const Fraction& b) {
    if (a.under == b.under) return a.over.compare(b.over) <=> 0;
    return (a.over * b.under).compare(b.over * a.under) <=> 0;
  }
  friend bool operator==(const Fraction& a, const Fraction& b) { return (a <=> b) == 0; }
};

// For any `under` but 0.
inline Fraction fraction(const Integer& over, const Integer& under) {
  return under < 0 ? Fraction{-over, -under} : Fraction{over, under};
}

// The largest integer that is not above it, and whether it is that integer.
struct Floor {
  Integer whole;
  bool is_exact;
};
inline Floor floor_of(const Fraction& value) {
  Integer whole, rest;
  mpz_fdiv_qr(whole.backend().data(), rest.backend().data(), value.over.backend().data(), value.under.backend().data());
  return {std::move(whole), rest.is_zero()};
}
inline Integer floor(const Fraction& value) {
  return floor_of(value).whole;
}

inline bool is_whole(const Fraction& value) {
  return floor_of(value).is_exact;
}

}  // namespace forceshade::reference::meshes
