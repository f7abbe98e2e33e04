// SPDX-License-Identifier: BSD-3-Clause
// The numbers both sides compute with: their enclosures enclose, their bounds are not idle, their roundings are right.

#include "reference/numbers/numbers.h"

#include <gtest/gtest.h>

#include <random>

#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/double_double.h"
#include "fast/numbers/first_stage.h"
#include "properties/binary32.h"
#include "reference/numbers/decimal.h"
#include "reference/numbers/interval_ends.h"
#include "reference/numbers/taylor.h"

namespace forceshade {
namespace {

using reference::Multiprecision;

struct Operands {
  double a, b;
};

// a positive, b of about its size and either sign, and sometimes so close that they cancel.
Operands operands(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.5, 2);
  const double a = uniform(random);
  const double b =
      random() % 4 == 0 ? a * (1 + std::ldexp(uniform(random), -static_cast<int>(random() % 50))) : uniform(random);
  return {a, random() % 2 == 0 ? b : -b};
}

// (a·b - a/b)·√a + b, in any number type.
template <class N, class From, class Root>
N expression(const Operands& o, const From& from, const Root& root) {
  const N a = from(o.a), b = from(o.b);
  return (a * b - a / b) * root(a) + b;
}

Multiprecision truth(const Operands& o) {
  return expression<Multiprecision>(
      o, [](double v) { return Multiprecision(v); }, [](const Multiprecision& v) { return Multiprecision(sqrt(v)); });
}

class Numbers : public ::testing::Test {
 protected:
  void SetUp() override { reference::set_precision(6000); }
  std::mt19937_64 random{7};
};

TEST_F(Numbers, double_double_encloses_and_its_bound_is_not_idle) {
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Operands o = operands(random);
    const auto value =
        expression<fast::DoubleDouble>(o, &fast::DoubleDouble::exactly, [](const auto& v) { return square_root(v); });
    const auto error = static_cast<double>(Multiprecision(abs(truth(o) - Multiprecision(value.hi) - Multiprecision(value.lo))));
    ASSERT_LE(error, value.error) << o.a << ' ' << o.b;
    worst = std::max(worst, error / value.error);
  }
  std::printf("  worst error/bound %.3f\n", worst);
  EXPECT_GT(worst, 0.01) << "the bound is idle";
}

TEST_F(Numbers, wide_encloses_to_its_full_width) {
  using BigFloatBall = fast::BigFloatBall<64>;
  for (int i = 0; i < 300; ++i) {
    const Operands o = operands(random);
    const auto value = expression<BigFloatBall>(o, &BigFloatBall::exactly, [](const auto& v) { return square_root(v); });
    EXPECT_LT(value.error_exponent(), -3900);
    // Taken apart into binary64 pieces, largest first.
    Multiprecision sum = 0;
    BigFloatBall rest = value;
    for (int piece = 0; piece < 90; ++piece) {
      const double head = approximately(rest);
      if (head == 0) break;
      sum += head;
      rest = midpoint(rest - BigFloatBall::exactly(head));
    }
    const Multiprecision error = abs(truth(o) - sum);
    // The pieces stop at binary64's own end, 2^-1074.
    EXPECT_LE(error, pow(Multiprecision(2), -1060)) << o.a << ' ' << o.b;
  }
}

TEST_F(Numbers, wide_knows_zero) {
  using BigFloatBall = fast::BigFloatBall<32>;
  const BigFloatBall two = BigFloatBall::exactly(2), root = square_root(two);
  EXPECT_EQ(sign(root * root - two), fast::Sign::zero);
  EXPECT_EQ(sign(root - BigFloatBall::exactly(1.4142135623730951)), fast::Sign::negative);
  EXPECT_EQ(sign(BigFloatBall::exactly(0)), fast::Sign::zero);
  EXPECT_EQ(sign(BigFloatBall::exactly(-0x1p-1000)), fast::Sign::negative);
}

TEST_F(Numbers, a_divisor_that_may_be_zero_leaves_everything_unknown) {
  using fast::DoubleDouble;
  const DoubleDouble third = DoubleDouble::exactly(1) / DoubleDouble::exactly(3);
  const DoubleDouble may_be_zero = third * DoubleDouble::exactly(3) - DoubleDouble::exactly(1);
  EXPECT_EQ(sign(may_be_zero), fast::Sign::unknown);
  EXPECT_EQ(sign(DoubleDouble::exactly(1) / may_be_zero), fast::Sign::unknown);
}

TEST_F(Numbers, rounding_of_a_ball_is_to_nearest_even_or_unknown) {
  using fast::DoubleDouble;
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble::exactly(0.1)), 0.1F);
  const double tie = 1 + 0x1p-24, odd_tie = 1 + 3 * 0x1p-24;
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble::exactly(tie)), 1.0F) << "down to even";
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble::exactly(odd_tie)), 1 + 0x1p-22F) << "up to even";
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble{tie, 0x1p-80, 0x1p-100}), 1 + 0x1p-23F) << "a hair above the tie";
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble{tie, -0x1p-80, 0x1p-100}), 1.0F);
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble{tie, 0, 0x1p-100}), std::nullopt) << "cannot tell";
  const double smallest = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble::exactly(0.75 * smallest)), std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(fast::round_to_binary32(DoubleDouble::exactly(0.5 * smallest)), 0.0F);
  EXPECT_FALSE(std::signbit(fast::round_to_binary32(DoubleDouble::exactly(-0.25 * smallest)).value())) << "no negative zero";
}

TEST_F(Numbers, rounding_is_in_doubt_exactly_in_the_window) {
  constexpr double kBound = 0x1p-48;
  constexpr int kWindow = fast::doubt_window(kBound);
  for (int i = 0; i < 100000; ++i) {
    const auto head = static_cast<float>(operands(random).a);
    const double tie = 0.5 * (static_cast<double>(head) + static_cast<double>(std::nextafter(head, 4.0F)));
    const double near = tie * (1 + std::ldexp(1.0, -48 - static_cast<int>(random() % 4)) * (random() % 2 == 0 ? 1 : -1));
    const double far = tie * (1 + 3 * kBound * (random() % 2 == 0 ? 1 : -1));
    ASSERT_TRUE(fast::rounding_is_in_doubt<kWindow>(near)) << near;
    ASSERT_TRUE(fast::rounding_is_in_doubt<kWindow>(-near)) << near;
    ASSERT_FALSE(fast::rounding_is_in_doubt<kWindow>(far)) << far;
    ASSERT_FALSE(fast::rounding_is_in_doubt<kWindow>(-far)) << far;
  }
  EXPECT_FALSE(fast::rounding_is_in_doubt<kWindow>(0.0));
}

TEST_F(Numbers, split_heads_multiply_without_rounding) {
  for (int i = 0; i < 100000; ++i) {
    const double value = operands(random).a;
    const fast::Split parts = fast::split(fast::DoubleDouble::exactly(value));
    ASSERT_EQ(parts.head + parts.tail, value);
    const auto factor = static_cast<double>(static_cast<float>(operands(random).b));
    ASSERT_EQ(std::fma(parts.head, factor, -(parts.head * factor)), 0) << value << ' ' << factor;
    const fast::Split more = fast::split({value, 0x1p-60 * value, 0});
    ASSERT_EQ(more.head, parts.head);
    ASSERT_EQ(more.tail, parts.tail + 0x1p-60 * value) << "the second number belongs to the tail";
  }
}

TEST_F(Numbers, numbers_of_64_bits_enclose_the_interval_they_are_made_of) {
  for (int i = 0; i < 1000; ++i) {
    const Operands o = operands(random);
    reference::set_precision(i % 2 == 0 ? 80 : 40);
    const reference::Enclosure value = sqrt(reference::Enclosure(o.a)) / 3;
    const reference::Ball64 ball = reference::to_64_bits(value);
    reference::set_precision(6000);
    const Multiprecision mid = ball.mid(), rad = ball.rad();
    ASSERT_LE(mid - rad, Multiprecision(lower(value)));
    ASSERT_GE(mid + rad, Multiprecision(upper(value)));
    ASSERT_GT(ball.rad(), 0);
  }
  EXPECT_EQ(reference::to_64_bits(reference::Enclosure(0.75)).rad(), 0) << "known exactly";
  EXPECT_GT(reference::to_64_bits(ldexp(reference::Enclosure(1), -20000)).rad(), 0) << "not 0, though below all long doubles";
}

TEST_F(Numbers, taylor_encloses_over_its_whole_stretch_and_its_rest_is_not_idle) {
  using reference::Taylor;
  long double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    Operands o = operands(random);
    o.a = static_cast<double>(static_cast<float>(o.a));  // so that a + reach·s is exact
    const double reach = std::ldexp(1.0, -3 - static_cast<int>(random() % 12));
    // (a·b - a/b)·√a + b with a varying.
    const auto value = expression<Taylor>(
        o, [&](double v) { return v == o.a ? Taylor::variable(v, reach) : Taylor(v); },
        [](const Taylor& v) { return sqrt(v); });
    for (const double s : {-1.0, -0.625, 0.25, 1.0}) {
      const Multiprecision at = truth({o.a + reach * s, o.b});
      Multiprecision cubic = 0;
      for (std::size_t k = 4; k-- > 0;) cubic = cubic * Multiprecision(s) + Multiprecision(value.coefficient(k));
      const Multiprecision error = abs(at - cubic);
      ASSERT_LE(error, Multiprecision(value.rest())) << o.a << ' ' << o.b << ' ' << reach << ' ' << s;
      worst = std::max(worst, static_cast<long double>(Multiprecision(error / Multiprecision(value.rest()))));
    }
  }
  std::printf("  worst error/rest %.3Lf\n", worst);
  EXPECT_GT(worst, 0.1L) << "the rest is idle";
}

TEST_F(Numbers, taylor_encloses_each_operation_by_itself) {
  using reference::Taylor;
  for (int i = 0; i < 500; ++i) {
    const double mid = static_cast<double>(static_cast<float>(operands(random).a));
    const double reach = std::ldexp(mid, -3 - static_cast<int>(random() % 8));
    const Taylor x = Taylor::variable(mid, reach), square = x * x;
    for (const double s : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const Multiprecision at = Multiprecision(mid) + Multiprecision(reach) * s;
      const auto expect_within = [&](const Taylor& value, const Multiprecision& exact) {
        Multiprecision cubic = 0;
        for (std::size_t k = 4; k-- > 0;) cubic = cubic * Multiprecision(s) + Multiprecision(value.coefficient(k));
        EXPECT_LE(Multiprecision(abs(exact - cubic)), Multiprecision(value.rest())) << mid << ' ' << reach << ' ' << s;
      };
      expect_within(square * square, at * at * at * at);
      expect_within(Taylor(1.0) / x, 1 / at);
      expect_within(sqrt(x), sqrt(at));
      expect_within(Taylor(3.0) * sqrt(x), 3 * sqrt(at));
      expect_within(sqrt(x) * x - x, sqrt(at) * at - at);
    }
  }
}

TEST_F(Numbers, taylor_throws_where_it_cannot_tell) {
  using reference::Taylor, reference::Undecided;
  const Taylor x = Taylor::variable(1, 0.125);
  EXPECT_TRUE(x < Taylor(1.25));
  EXPECT_FALSE(x < Taylor(0.75));
  EXPECT_THROW((void)(x < Taylor(1.0)), Undecided);
  EXPECT_THROW((void)(x / (x - Taylor(1.0))), Undecided);
  EXPECT_THROW((void)(Taylor(1.0) / Taylor::variable(1, 0.5)), Undecided) << "too wide for its series";
  EXPECT_THROW((void)sqrt(x - Taylor(2.0)), Undecided);
}

TEST_F(Numbers, decimals_are_rounded_to_even_on_ties) {
  const auto exactly = [](double value, unsigned digits) {
    return reference::correctly_rounded(
        digits, [=] { return reference::Enclosure(value); }, [](const CORE::BigRat&) { return 0; });
  };
  EXPECT_EQ(exactly(0.125, 2), "0.12");
  EXPECT_EQ(exactly(0.375, 2), "0.38");
  EXPECT_EQ(exactly(-1234.5, 2), "-1200");
  EXPECT_EQ(exactly(9.996, 3), "10.0");
  EXPECT_EQ(exactly(0, 3), "0");
  EXPECT_EQ(exactly(12, 2), "12");
  EXPECT_EQ(exactly(-0.0625, 1), "-0.06");
  // √2·√2 is 2 only to those who can compare exactly: what the enclosures leave open, `beyond` decides.
  const auto blurred = [](double value, int beyond) {
    return reference::correctly_rounded(
        3,
        [=] {
          const reference::Enclosure root = sqrt(reference::Enclosure(2));
          return reference::Enclosure(root * root - 2 + reference::Enclosure(value));
        },
        [=](const CORE::BigRat& q) {
          if (q == CORE::BigRat(0)) return value < 0 ? -1 : 1;
          EXPECT_EQ(CORE::BigRat(value), q) << "asked about the tie";
          return beyond;
        });
  };
  for (const int square : {2, 3, 5, 6, 7, 10, 11}) {
    const auto zero = [=] {
      const reference::Enclosure root = sqrt(reference::Enclosure(square));
      return reference::Enclosure(root * root / 3 - reference::Enclosure(square) / 3);
    };
    EXPECT_EQ(reference::correctly_rounded(3, zero, [](const CORE::BigRat& q) { return -sign(q); }), "0");
  }
  EXPECT_EQ(blurred(2.125, 0), "2.12");
  EXPECT_EQ(blurred(2.375, 0), "2.38");
  EXPECT_EQ(blurred(-2.125, 0), "-2.12");
  EXPECT_EQ(blurred(-2.375, 0), "-2.38");
  EXPECT_EQ(blurred(2.125, 1), "2.13");
  EXPECT_EQ(blurred(2.375, -1), "2.37");
  EXPECT_EQ(blurred(-2.125, -1), "-2.13");
  EXPECT_EQ(blurred(-2.375, 1), "-2.37");
  EXPECT_EQ(blurred(2125, 0), "2120");
  EXPECT_EQ(blurred(21350, 0), "21400");
}

}  // namespace
}  // namespace forceshade
