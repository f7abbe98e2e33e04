// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/interval.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace forceshade::mesh {
namespace {

int length_of(const Whole& number) {
  const auto& limbs = number.backend();
  return static_cast<int>((limbs.size() - 1) * limbs.limb_bits) +
         static_cast<int>(std::bit_width(limbs.limbs()[limbs.size() - 1]));
}

// A number less than 1 or so from the root of a positive one: Newton's method, each step of which doubles the bits of the
// root's beginning, from those of binary64 on. sqrt() bounds how near it is.
Whole near_root(const Whole& number) {
  const int all = (length_of(number) + 1) / 2;
  int steps = 0;
  while ((all >> steps) > 26) ++steps;
  int bits = all >> steps;
  const auto first = static_cast<std::uint64_t>(number >> (2 * (all - bits)));
  Whole root(static_cast<std::uint64_t>(std::sqrt(static_cast<double>(first))));
  while (steps > 0) {
    const int before = std::exchange(bits, all >> --steps);
    root = ((root << (bits - before)) + (number >> (2 * all - before - bits)) / root) >> 1;
  }
  return root;
}

// The binary32 number nearest to number * 2^exponent, ties to even.
float nearest_binary32(const Whole& number, int exponent) {
  const Whole size = abs(number);
  const int last = std::max(exponent + length_of(size) - 24, -149);  // the exponent of its last bit
  const int dropped = last - exponent;
  Whole kept = dropped > 0 ? Whole(size >> dropped) : Whole(size << -dropped);
  if (dropped > 0) {
    const Whole rest = size - (kept << dropped), half = Whole(1) << (dropped - 1);
    if (rest > half || (rest == half && bit_test(kept, 0))) ++kept;
  }
  const double nearest = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(kept)), last);
  return static_cast<float>(number < 0 ? -nearest : nearest);
}

}  // namespace

// A shift drops less than one unit of the centre, and its radius is rounded up. It is one of the size, because Boost 1.74
// shifts a negative number whose last 64 bits are 1 to a positive one.
Interval::Interval(int bits, Whole centre, Whole radius, int exponent)
    : centre_(std::move(centre)), radius_(std::move(radius)), exponent_(exponent), bits_(bits) {
  const int dropped = std::max(length_of(centre_), length_of(radius_)) - bits;
  if (dropped <= 0) return;
  const bool is_negative = centre_ < 0;
  centre_ = abs(centre_) >> dropped;
  if (is_negative) centre_ = -centre_;
  radius_ = (radius_ >> dropped) + 2;
  exponent_ += dropped;
}

Interval::Interval(int bits, double number) : bits_(bits) {
  const double fraction = std::frexp(number, &exponent_);
  exponent_ -= 53;
  *this = Interval(bits, Whole(static_cast<std::int64_t>(std::ldexp(fraction, 53))), 0, exponent_);
}

Interval Interval::operator-() const {
  return {bits_, Whole(-centre_), radius_, exponent_};
}

Interval operator+(const Interval& a, const Interval& b) {
  if (a.exponent_ < b.exponent_) {
    const int shift = b.exponent_ - a.exponent_;
    return {a.bits_, Whole(a.centre_ + (b.centre_ << shift)), Whole(a.radius_ + (b.radius_ << shift)), a.exponent_};
  }
  const int shift = a.exponent_ - b.exponent_;
  return {a.bits_, Whole((a.centre_ << shift) + b.centre_), Whole((a.radius_ << shift) + b.radius_), b.exponent_};
}

Interval operator*(const Interval& a, const Interval& b) {
  Whole radius = abs(a.centre_) * b.radius_ + (abs(b.centre_) + b.radius_) * a.radius_;
  return {a.bits_, Whole(a.centre_ * b.centre_), std::move(radius), a.exponent_ + b.exponent_};
}

// With the centres c and d, the radii r and s, and x/y a quotient of the intervals,
// |x/y - c/d| = |(x - c) d - c (y - d)|/|y d| <= (r + |c/d| s)/(|d| - s).
Interval operator/(const Interval& a, const Interval& b) {
  if (b.has_zero()) throw std::domain_error("a divisor that may be 0");
  const Whole size = abs(b.centre_);
  const int shift = std::max(a.bits_ + 1 + length_of(size) - length_of(a.centre_), 0);
  Whole quotient = (a.centre_ << shift) / b.centre_;  // less than 1 from c/d 2^shift
  Whole radius = ((a.radius_ << shift) + (abs(quotient) + 1) * b.radius_) / (size - b.radius_) + 2;
  return {a.bits_, std::move(quotient), std::move(radius), a.exponent_ - b.exponent_ - shift};
}

// In as many bits as there are; each division drops less than 1.
Interval Interval::divided_by(int number) const {
  const int shift = std::max(bits_ - length_of(centre_), 0);
  return {bits_, Whole((centre_ << shift) / number), Whole((radius_ << shift) / number + 2), exponent_ - shift};
}

// With q > 0 and x a number of the interval with centre c and radius r, |sqrt(x) - q| = |x - q^2|/(sqrt(x) + q)
// <= (|c - q^2| + r)/q.
Interval sqrt(const Interval& a) {
  if (a.centre_ <= a.radius_) throw std::domain_error("a root of what may not be positive");
  int shift = std::max(2 * a.bits_ - length_of(a.centre_), 0);
  shift += (a.exponent_ - shift) & 1;
  const Whole centre = a.centre_ << shift;
  Whole root = near_root(centre);
  Whole radius = (abs(centre - root * root) + (a.radius_ << shift)) / root + 1;
  return {a.bits_, std::move(root), std::move(radius), (a.exponent_ - shift) / 2};
}

// atan y = 2 atan(y/(1 + sqrt(1 + y^2))) until y is small, then y - y^3/3 + y^5/5 - ..., whose terms fall, so that what is left
// out is at most its first term.
Interval atan(const Interval& a) {
  const int bits = a.bits_;
  const Interval one(bits, Whole(1));
  const int small = -1 - static_cast<int>(std::sqrt(bits) / 4);
  Interval y = a;
  int halvings = 0;
  for (; y.magnitude() > small; ++halvings) y = y / (one + sqrt(one + y * y));
  const Interval minus_square = -(y * y);
  Interval sum = y, power = y;
  for (int k = 3;; k += 2) {
    power = power * minus_square;
    const Interval term = power.divided_by(k);
    if (term.magnitude() < sum.magnitude() - bits) {
      sum = sum + term * Interval::of_units(bits);
      sum.exponent_ += halvings;
      return sum;
    }
    sum = sum + term;
  }
}

// 1 - y^2/2! + y^4/4! - ...: what is left out is at most its first term, in Lagrange's form of the remainder.
Interval cos(const Interval& a) {
  const int bits = a.bits_;
  const Interval minus_square = -(a * a);
  Interval sum(bits, Whole(1)), term = sum;
  for (int k = 2;; k += 2) {
    term = (term * minus_square).divided_by(k * (k - 1));
    if (term.magnitude() < -bits) return sum + term * Interval::of_units(bits);
    sum = sum + term;
  }
}

// J. Machin, 1706.
Interval Interval::pi(int bits) {
  const auto times_atan_of_inverse = [bits](int factor, int number) {
    return Interval(bits, Whole(factor)) * atan(Interval(bits, Whole(1)) / Interval(bits, Whole(number)));
  };
  return times_atan_of_inverse(16, 5) - times_atan_of_inverse(4, 239);
}

int Interval::magnitude() const {
  return std::max(length_of(centre_), length_of(radius_)) + 1 + exponent_;
}

float Interval::nearest_to_low() const {
  return nearest_binary32(centre_ - radius_, exponent_);
}

float Interval::nearest_to_high() const {
  return nearest_binary32(centre_ + radius_, exponent_);
}

}  // namespace forceshade::mesh
