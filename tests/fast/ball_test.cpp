// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the exact stages where they lose most: divisors that may be 0, roots of what may be, and the last bits of
// BigFloatBall, cut to two limbs. ball_corners_test.cpp has every operation.

#include "fast/numbers/ball.h"

#include <gtest/gtest.h>

#include <random>

#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/double_double.h"

namespace forceshade::fast {
namespace {

using Wide2 = BigFloatBall<2>;
constexpr int kLostBits = 9;  // by a quotient or a root of Wide2, of its 128

TEST(ball, double_double_leaves_everything_open_after_a_division_by_what_may_be_zero) {
  for (const double hi : {0.0, 0x1p-100, -0x1p-100})
    EXPECT_EQ(sign(DoubleDouble::exactly(1) / DoubleDouble{hi, 0, 0x1p-99}), Sign::unknown) << hi;
}

TEST(ball, wide_leaves_everything_open_after_a_division_by_what_may_be_zero) {
  const Wide2 root = square_root(Wide2::exactly(2));
  const Wide2 quotient = Wide2::exactly(1) / (root * root - Wide2::exactly(2));
  EXPECT_EQ(sign(quotient), Sign::zero);
  EXPECT_GT(quotient.error_exponent(), 1000);
}

TEST(ball, wide_has_a_root_that_covers_whatever_a_small_number_may_be) {
  // 2 - √2·√2 is zero, and enclosed with a sign: its root is within √(its bound) of zero.
  for (const double value : {2.0, 3.0, 5.0, 7.0, 11.0, 13.0}) {
    const Wide2 root = square_root(Wide2::exactly(value));
    for (const Wide2& nothing : {root * root - Wide2::exactly(value), Wide2::exactly(value) - root * root}) {
      EXPECT_EQ(sign(square_root(nothing)), Sign::zero);
      EXPECT_GE(2 * square_root(nothing).error_exponent(), nothing.error_exponent());
    }
  }
  EXPECT_EQ(sign(square_root(Wide2::exactly(0))), Sign::zero);
}

TEST(ball, wide_loses_no_more_than_a_few_of_its_last_bits) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(1, 4);
  // A number of any size, far beyond binary64's.
  const auto raised = [](Wide2 value, int times) {
    const Wide2 factor = Wide2::exactly(times < 0 ? 0x1p-501 : 0x1p501);
    for (int i = 0; i < std::abs(times); ++i) value = midpoint(value * factor);
    return value;
  };
  for (int i = 0; i < 500; ++i) {
    const double a = uniform(random), b = uniform(random);
    for (const int times : {-4, -3, 0, 3, 4}) {
      const Wide2 numerator = raised(Wide2::exactly(a), times), square = raised(Wide2::exactly(a), 2 * times);
      const Wide2 quotient = numerator / Wide2::exactly(b), root = square_root(square);
      // A number of the size of 2^(501 times): less than 4 of it, and 2.
      EXPECT_LE(quotient.error_exponent(), 501 * times + 2 - 128 + kLostBits);
      EXPECT_LE(root.error_exponent(), 501 * times + 1 - 128 + kLostBits);
      EXPECT_EQ(sign(quotient), Sign::positive);
      EXPECT_EQ(sign(root), Sign::positive);
      EXPECT_EQ(sign(quotient * Wide2::exactly(b) - numerator), Sign::zero);
      EXPECT_EQ(sign(root * root - square), Sign::zero);
    }
  }
}

// Quotients and roots use Newton's method with more steps and longer numbers, the wider a number is.
template <std::size_t kLimbs>
void loses_few_bits() {
  using Wide = BigFloatBall<kLimbs>;
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(1, 4);
  for (int i = 0; i < 100; ++i) {
    const double a = uniform(random), b = uniform(random);
    const Wide quotient = Wide::exactly(a) / Wide::exactly(b), root = square_root(Wide::exactly(a));
    const int least = kLostBits - 64 * static_cast<int>(kLimbs);
    ASSERT_LE(quotient.error_exponent(), 2 + least);
    ASSERT_LE(root.error_exponent(), 1 + least);
  }
}

TEST(ball, of_the_width_of_every_law_loses_no_more_than_a_few_of_its_last_bits) {
  loses_few_bits<4>();
  loses_few_bits<12>();
  loses_few_bits<32>();
  loses_few_bits<64>();
}

}  // namespace
}  // namespace forceshade::fast
