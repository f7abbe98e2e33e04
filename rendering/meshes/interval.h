// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Intervals of any precision, in integers alone, so that they are the same on every machine: every result encloses the exact
// one (docs/proofs.md, "Normals in doubt").

#include <boost/multiprecision/cpp_int.hpp>

namespace forceshade::mesh {

// An integer of any size; one of 512 bits or less takes no allocation.
using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

// The numbers from (centre - radius) 2^exponent to (centre + radius) 2^exponent. A result has the bits of its left operand:
// centre and radius have at most so many, and the digits that go make the radius larger.
class Interval {
 public:
  // 0 alone.
  explicit Interval(int bits) : bits_(bits) {}
  // One number, or the ones near it where it has more bits.
  Interval(int bits, const Whole& number) : Interval(bits, number, 0, 0) {}
  Interval(int bits, double number);
  // From -1 to 1.
  static Interval of_units(int bits) { return {bits, 0, 1, 0}; }
  static Interval pi(int bits);

  int bits() const { return bits_; }
  const Whole& centre() const { return centre_; }
  const Whole& radius() const { return radius_; }
  int exponent() const { return exponent_; }

  friend Interval operator+(const Interval& a, const Interval& b);
  friend Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
  Interval operator-() const;
  friend Interval operator*(const Interval& a, const Interval& b);
  // std::domain_error where b has zero.
  friend Interval operator/(const Interval& a, const Interval& b);
  // std::domain_error where a has a number that is not positive.
  friend Interval sqrt(const Interval& a);
  friend Interval atan(const Interval& a);
  friend Interval cos(const Interval& a);

  bool has_zero() const { return abs(centre_) <= radius_; }
  // True if every number of the one is below every number of the other.
  friend bool is_below(const Interval& a, const Interval& b) {
    const Interval difference = b - a;
    return difference.centre_ > difference.radius_;
  }
  // Every number is below 2^magnitude() in size.
  int magnitude() const;
  // The binary32 numbers nearest to the ends, ties to even.
  float nearest_to_low() const;
  float nearest_to_high() const;

 private:
  Interval divided_by(int number) const;  // a positive one
  Interval(int bits, Whole centre, Whole radius, int exponent);

  Whole centre_, radius_;
  int exponent_ = 0, bits_;
};

}  // namespace forceshade::mesh
