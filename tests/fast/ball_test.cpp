// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the exact stages on a random walk beside the same walk in 1600 bits. BigFloatBall is cut to two limbs, so that
// every operation rounds.

#include "fast/numbers/ball.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/multiprecision.h"

namespace forceshade::fast {
namespace {

using tests::bound_of;
using tests::Multiprecision;
using tests::value_of;
using Wide2 = BigFloatBall<2>;
constexpr int kLostBits = 9;  // by a quotient or a root of Wide2, of its 128

template <class N>
struct Walker {
  N ball;
  Multiprecision truth;
};

// A number of any size, either sign, few bits or many; now and then zero.
template <class N>
Walker<N> fresh(std::mt19937_64& random) {
  const int places = static_cast<int>(random() % 53) + 1;
  const double integer = std::floor(std::ldexp(std::uniform_real_distribution<double>(-1, 1)(random), places));
  const double value = std::ldexp(integer, static_cast<int>(random() % 140) - 70 - places);
  return {N::exactly(value), value};
}

template <class N>
void encloses_the_result_of_every_operation(double least_use_of_the_bound) {
  std::mt19937_64 random(11);
  std::array<Walker<N>, 6> walkers;
  for (Walker<N>& walker : walkers) walker = fresh<N>(random);
  std::array<int, 4> signs{};
  Multiprecision worst = 0;
  for (int i = 0; i < 60000; ++i) {
    const Walker<N>&a = walkers[random() % walkers.size()], &b = walkers[random() % walkers.size()];
    Walker<N>& result = walkers[random() % walkers.size()];
    Walker<N> next = fresh<N>(random);
    const Sign divisor = sign(b.ball);
    switch (random() % 7) {
      case 0: next = {a.ball + b.ball, a.truth + b.truth}; break;
      case 1: next = {a.ball - b.ball, a.truth - b.truth}; break;
      case 2: next = {a.ball * b.ball, a.truth * b.truth}; break;
      case 3:
        if (divisor == Sign::negative || divisor == Sign::positive) next = {a.ball / b.ball, a.truth / b.truth};
        break;
      case 4:
        if (a.truth >= 0) next = {square_root(a.ball), sqrt(a.truth)};
        break;
      case 5: next = {midpoint(a.ball), value_of(a.ball)}; break;  // exact, to the last bit
      default: break;
    }
    const Multiprecision error = abs(next.truth - value_of(next.ball)), bound = bound_of(next.ball);
    ASSERT_LE(error, bound) << "step " << i;
    worst = std::max<Multiprecision>(worst, bound > 0 ? Multiprecision(error / bound) : 0);
    const Sign decided = sign(next.ball);
    if (decided == Sign::zero || decided == Sign::unknown) {
      ASSERT_LE(abs(next.truth), 8 * bound) << "step " << i;
    } else {
      ASSERT_EQ(decided == Sign::positive, next.truth > 0) << "step " << i;
    }
    ++signs[static_cast<std::size_t>(decided)];
    // A number that has lost its bits, or has left the middle of binary64's range, starts anew.
    const Multiprecision size = abs(next.truth), reach = ldexp(Multiprecision(1), 150);
    const bool is_kept = size == 0 || (size < reach && size * reach > 1 && bound * 0x1p20 < size);
    result = is_kept ? next : fresh<N>(random);
  }
  std::printf("  signs: negative %d, zero %d, positive %d, unknown %d; worst error/bound %.3f\n", signs[0], signs[1], signs[2],
              signs[3], static_cast<double>(worst));
  EXPECT_GT(worst, least_use_of_the_bound) << "the bound is idle";
  for (const Sign reached : {Sign::negative, Sign::zero, Sign::positive})
    EXPECT_GT(signs[static_cast<std::size_t>(reached)], 1000);
}

TEST(ball, double_double_encloses_the_result_of_every_operation) {
  encloses_the_result_of_every_operation<DoubleDouble>(0.05);
}

TEST(ball, wide_encloses_the_result_of_every_operation) {
  encloses_the_result_of_every_operation<Wide2>(0.05);
}

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

}  // namespace
}  // namespace forceshade::fast
