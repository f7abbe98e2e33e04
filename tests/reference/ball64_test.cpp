// SPDX-License-Identifier: BSD-3-Clause
// The reference's cheap enclosure against 6000 bits: it encloses, and does not decide what it cannot know.

#include "reference/numbers/ball64.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <random>

namespace forceshade::reference {
namespace {

using Multiprecision =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<1800>, boost::multiprecision::et_off>;

std::array<Multiprecision, 3> ends_and_middle(const Ball64& ball) {
  const Multiprecision mid = ball.mid(), rad = ball.rad();
  return {mid - rad, mid, mid + rad};
}

void expect_in(const Ball64& ball, const Multiprecision& value) {
  ASSERT_LE(Multiprecision(abs(value - Multiprecision(ball.mid()))), Multiprecision(ball.rad()));
}

TEST(filter, encloses_the_result_for_every_member_of_its_operands) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.5, 2);
  // A ball of any width or none, about numbers of 53 bits or 24.
  const auto ball = [&] {
    double mid = random() % 2 == 0 ? uniform(random) : -uniform(random);
    if (random() % 4 == 0) mid = static_cast<double>(static_cast<float>(mid));
    const double rad = random() % 3 == 0 ? 0 : std::ldexp(uniform(random), -2 - static_cast<int>(random() % 60));
    return Ball64(static_cast<long double>(mid), static_cast<long double>(rad));
  };
  for (int i = 0; i < 10000; ++i) {
    const Ball64 a = ball(), b = ball();
    for (const Multiprecision& x : ends_and_middle(a)) {
      expect_in(-a, -x);
      if (a.mid() > 1.001L * a.rad()) expect_in(sqrt(a), sqrt(x));
      for (const Multiprecision& y : ends_and_middle(b)) {
        expect_in(a + b, x + y);
        expect_in(a - b, x - y);
        expect_in(a * b, x * y);
        if (std::fabs(b.mid()) > 1.001L * b.rad()) expect_in(a / b, x / y);
      }
    }
  }
}

TEST(filter, knows_the_product_of_two_binary32_numbers_exactly) {
  const Ball64 width(25.4F), two(2.0);
  EXPECT_EQ((width * two).rad(), 0);
  EXPECT_EQ((Ball64(0.1) * two).rad() > 0, true) << "binary64, of which it does not know";
  EXPECT_TRUE(two * Ball64(12.7F) <= width);
}

TEST(filter, compares_what_is_apart_and_throws_where_balls_meet) {
  const Ball64 third = Ball64(1.0) / Ball64(3.0), one = third * Ball64(3.0);
  EXPECT_TRUE(third < Ball64(0.34));
  EXPECT_FALSE(third < Ball64(0.33));
  EXPECT_TRUE(Ball64(0.34) > third);
  EXPECT_TRUE(Ball64(1.0) <= Ball64(1.0));
  EXPECT_FALSE(Ball64(1.0) < Ball64(1.0));
  EXPECT_FALSE(Ball64(1.5) <= Ball64(1.0));
  EXPECT_THROW(static_cast<void>(one < Ball64(1.0)), Undecided);
  EXPECT_THROW(static_cast<void>(Ball64(1.0L, 0x1p-10L) < Ball64(1.0L + 0x1p-11L, 0)), Undecided);
  EXPECT_THROW(static_cast<void>(Ball64(1.0L, 0x1p-10L) <= Ball64(1.0L - 0x1p-11L, 0)), Undecided);
  // From 1 + 0.3 units to 1 + 1.7, and from 1 - 0.4 to 1 + 0.4: rounded, the first's low end and the second's high end agree.
  const long double unit = 0x1p-63L;
  EXPECT_THROW(static_cast<void>(Ball64(1 + unit, 0.7L * unit) < Ball64(1.0L, 0.4L * unit)), Undecided);
}

TEST(filter, throws_on_a_divisor_or_a_root_of_unknown_sign) {
  EXPECT_THROW(Ball64(0.0) / Ball64(0.0), Undecided);
  EXPECT_THROW(Ball64(1.0) / Ball64(1.0L, 2.0L), Undecided);
  EXPECT_THROW(sqrt(Ball64(1.0L, 2.0L)), Undecided);
  EXPECT_EQ(sqrt(Ball64(0.0)).rad(), 0);
  EXPECT_EQ((Ball64(1.5) / Ball64(1.5)).rad(), 0);
  EXPECT_GT((Ball64(1.5L, 0x1p-20L) / Ball64(1.5)).rad(), 0x1p-21L) << "not known to be 1";
}

TEST(filter, rounds_to_binary32_where_both_ends_agree) {
  EXPECT_EQ(Ball64(1.0L + 0x1p-24L + 0x1p-40L, 0x1p-41L).round(), 1 + 0x1p-23F);
  EXPECT_EQ(Ball64(1.0L + 0x1p-24L - 0x1p-40L, 0x1p-41L).round(), 1.0F);
  // A tie between the ends, on either side of the middle.
  EXPECT_THROW(static_cast<void>(Ball64(1.0L + 0x1p-24L + 0x1p-40L, 0x1p-39L).round()), Undecided);
  EXPECT_THROW(static_cast<void>(Ball64(1.0L + 0x1p-24L - 0x1p-40L, 0x1p-39L).round()), Undecided);
  EXPECT_FALSE(std::signbit(Ball64(-0.0).round()));
}

}  // namespace
}  // namespace forceshade::reference
