// SPDX-License-Identifier: BSD-3-Clause
// The bound of a quotient of two balls (fast/soups/numbers.h) holds below the least normal number, too; and points are told
// apart where binary64 cannot.

#include <gtest/gtest.h>

#include <cmath>

#include "fast/soups/points.h"

namespace forceshade::fast::soups {
namespace {

// The quotients by both ends of the divisor, whose differences to a power of two are exact here.
void expect_in(const Ball& quotient, double a, const Ball& b) {
  for (const double divisor : {b.value - b.error, b.value + b.error})
    EXPECT_LE(std::fabs(a / divisor - quotient.value), quotient.error) << a << " over " << b.value << " ± " << b.error;
}

TEST(soup_quotients, what_is_lost_below_the_least_normal_number_is_in_the_bound) {
  for (const int exponent : {-1073, -1060, -1040, -1000, -500, 0})
    for (const double part : {0.25, 0.4375, 0.75, 1 - 0x1p-20, 1 - 0x1p-52})
      for (const int of_a : {-1074, -1073, -1070, -1050, -1020, -500}) {
        const double size = std::ldexp(1.0, exponent), a = std::ldexp(1.0, of_a);
        const Ball b{size, size * part};
        if (b.error < b.value) expect_in(Ball::exactly(a) / b, a, b);
      }
}

TEST(soup_quotients, a_divisor_that_may_be_zero_decides_nothing) {
  EXPECT_FALSE((Ball::exactly(1) / Ball{1, 1}).is_sure());
  EXPECT_FALSE((Ball::exactly(1) / Ball{0x1p-1074, 0x1p-1000}).is_sure());
}

// Points that binary64 does not tell apart, a unit from each other along one axis.
TEST(soup_points, are_the_same_only_if_all_coordinates_are) {
  const Whole far = Whole::scaled(1, 62), farther = far + Whole(1);
  const Point a(Scaled<Whole>{{far, far, far}, Whole(1)});
  EXPECT_TRUE(is_same(a, a));
  EXPECT_FALSE(is_same(a, Point(Scaled<Whole>{{farther, far, far}, Whole(1)})));
  EXPECT_FALSE(is_same(a, Point(Scaled<Whole>{{far, farther, far}, Whole(1)})));
  EXPECT_FALSE(is_same(a, Point(Scaled<Whole>{{far, far, farther}, Whole(1)})));
}

}  // namespace
}  // namespace forceshade::fast::soups
