// SPDX-License-Identifier: BSD-3-Clause
// The exact numbers behind the last stage of height maps: fractions, and fields of their roots.

#include <gtest/gtest.h>

#include <random>

#include "fast/numbers/fraction.h"
#include "fast/numbers/root_field.h"

namespace forceshade {
namespace {

using fast::Fraction;
using fast::RootField;
using fast::RootNumber;
using fast::Sign;

Fraction whole(double value) {
  return Fraction::exactly(value);
}

TEST(fraction, computes_with_rational_numbers_exactly) {
  const Fraction third = whole(1) / whole(3), fifth = whole(-1) / whole(-5);
  EXPECT_TRUE((third + fifth - whole(8) / whole(15)).is_zero());
  EXPECT_TRUE((third * fifth - whole(1) / whole(15)).is_zero());
  EXPECT_TRUE((third / fifth - whole(5) / whole(3)).is_zero());
  EXPECT_TRUE((third + third + third - whole(1)).is_zero());
  EXPECT_EQ(sign(third - whole(0x1.5555555555555p-2)), Sign::positive);
  EXPECT_EQ(sign(whole(0x1.5555555555555p-2) - third), Sign::negative);
  EXPECT_TRUE((whole(0x1p-1000) * whole(3) / whole(0x1p-1000)).is_whole()) << "a power of two is no denominator";
  EXPECT_EQ(sign(whole(1) / whole(-3)), Sign::negative);
}

TEST(fraction, says_so_where_it_has_no_room) {
  Fraction power = whole(1) / whole(3);
  int doublings = 0;
  while (power.is_exact() && doublings < 20) {
    power = power * power;
    ++doublings;
  }
  EXPECT_EQ(doublings, 13) << "3^(2^12) has 6493 bits, its square has 12985";
  EXPECT_EQ(sign(power), Sign::unknown);
  EXPECT_EQ(sign(power - power), Sign::unknown);
  EXPECT_EQ(sign(whole(1) / whole(0)), Sign::unknown);
  EXPECT_EQ(sign(whole(1) / whole(0) * whole(0)), Sign::unknown);
  Fraction tiny = whole(0x1p-1000);
  for (int i = 0; i < 3; ++i) tiny = tiny * tiny;  // 2^-8000
  EXPECT_EQ(sign(whole(1) + tiny - whole(1)), Sign::positive);
  EXPECT_EQ(sign(whole(1) + tiny * tiny), Sign::unknown) << "16001 bits";
}

TEST(root_field, finds_roots_that_are_related) {
  RootField field;
  const auto root = [&](double radicand) {
    RootNumber number(field);
    number.add(field.root(whole(radicand)).value(), whole(1));
    return number;
  };
  const auto minus = [&](double value) { return RootNumber(field, whole(-value)); };
  EXPECT_TRUE((root(25) + minus(5)).is_zero());
  EXPECT_TRUE((root(0.0625) + minus(0.25)).is_zero());
  EXPECT_TRUE((root(2) * root(2) + minus(2)).is_zero());
  EXPECT_TRUE((root(8) + -(whole(2) * root(2))).is_zero());
  EXPECT_TRUE((root(2) * root(3) + -root(6)).is_zero()) << "6 is no third root";
  EXPECT_TRUE(((root(2) + root(3)) * (root(2) + root(3)) + minus(5) + -(whole(2) * root(24)) + whole(2) * root(6)).is_zero());
  EXPECT_TRUE((root(5) * root(30) * root(6) + minus(30)).is_zero());
  EXPECT_FALSE((root(2) + root(3) + -root(10)).is_zero());
  EXPECT_FALSE(field.root(whole(7)).has_value()) << "a fourth root";
  EXPECT_TRUE(field.root(whole(49)).has_value());
  EXPECT_TRUE(field.root(whole(30 * 49)).has_value());
}

TEST(root_field, tells_squares_from_their_neighbours) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 200; ++i) {
    RootField field;
    const auto odd = static_cast<double>(random() >> 12 | 1), other = static_cast<double>(random() >> 13 | 1);
    const Fraction side = whole(odd) * whole(other), square = side * side;
    const auto root = field.root(square);
    ASSERT_TRUE(root.has_value());
    EXPECT_EQ(root->subset, 0U);
    EXPECT_TRUE((root->factor - side).is_zero());
    EXPECT_NE(field.root(square + whole(1))->subset, 0U);
    EXPECT_NE(field.root(square - whole(1))->subset, 0U);
  }
}

}  // namespace
}  // namespace forceshade
