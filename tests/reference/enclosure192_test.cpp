// SPDX-License-Identifier: BSD-3-Clause
// The interval of 192 bits: it encloses, decides what 64 bits cannot, and does not decide what it cannot know.

#include "reference/numbers/enclosure192.h"

#include <gtest/gtest.h>

#include <random>

namespace forceshade::reference {
namespace {

const Enclosure192 kTie(1 + 0x1p-24), kOne(1), kThree(3);  // between the binary32 1 and 1 + 2^-23

TEST(enclosure192, encloses_sums_products_quotients_and_roots) {
  using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<600>, boost::multiprecision::et_off>;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0.5, 2);
  for (int i = 0; i < 1000; ++i) {
    const double x = uniform(random), y = random() % 2 == 0 ? uniform(random) : -uniform(random);
    const Enclosure192 a(x), b(y);
    const auto expect = [&](const Enclosure192& enclosure, const Exact& value) {
      const Ball64 ball = to_64_bits(enclosure);
      EXPECT_LE(Exact(abs(value - Exact(ball.mid()))), Exact(ball.rad())) << x << ' ' << y;
      EXPECT_LE(ball.rad(), 0x1p-61L * std::fabs(ball.mid()) + 0x1p-115L) << x << ' ' << y;
    };
    expect(-a, -Exact(x));
    expect(a + b, Exact(x) + Exact(y));
    expect(a - b, Exact(x) - Exact(y));
    expect(a * b, Exact(x) * Exact(y));
    expect(a / b, Exact(x) / Exact(y));
    expect(sqrt(a), sqrt(Exact(x)));
  }
}

TEST(enclosure192, rounds_what_64_bits_leave_open) {
  const Enclosure192 little = Enclosure192(0x1p-150);
  EXPECT_EQ((kTie + little).round(), 1 + 0x1p-23F);
  EXPECT_EQ((kTie - little).round(), 1.0F);
  EXPECT_EQ(kTie.round(), 1.0F) << "ties to even";
  EXPECT_FALSE(std::signbit((-Enclosure192(0x1p-160)).round())) << "a zero is +0";
  EXPECT_THROW(static_cast<void>((kTie * (kOne / kThree) * kThree).round()), Undecided);
}

TEST(enclosure192, compares_what_is_apart_and_throws_where_intervals_meet) {
  const Enclosure192 third = kOne / kThree, around_one = third * kThree;
  EXPECT_TRUE(third < third + Enclosure192(0x1p-150));
  EXPECT_FALSE(third + Enclosure192(0x1p-150) < third);
  EXPECT_TRUE(third > third - Enclosure192(0x1p-150));
  EXPECT_TRUE(kOne <= kOne);
  EXPECT_FALSE(kOne < kOne);
  EXPECT_FALSE(kOne > kOne);
  EXPECT_FALSE(kThree <= kOne);
  EXPECT_THROW(static_cast<void>(around_one < kOne), Undecided);
  EXPECT_THROW(static_cast<void>(around_one <= kOne), Undecided);
  EXPECT_THROW(static_cast<void>(around_one > kOne), Undecided);
}

TEST(enclosure192, decides_nothing_of_a_divisor_or_a_root_of_unknown_sign) {
  const Enclosure192 around_zero = kOne / kThree * kThree - kOne;
  EXPECT_THROW(static_cast<void>((kOne / around_zero).round()), Undecided);
  EXPECT_THROW(static_cast<void>(sqrt(around_zero).round()), Undecided);
  EXPECT_THROW(static_cast<void>(Enclosure192(0x1p-300) < sqrt(around_zero)), Undecided);
}

TEST(enclosure192, takes_a_wider_enclosure_rounded_outwards) {
  const std::lock_guard lock(exact_arithmetic);
  set_precision(512);
  const Enclosure wide = Enclosure(1) / 3;
  const Enclosure192 taken(wide);
  EXPECT_THROW(static_cast<void>(taken * kThree < kOne), Undecided);
  EXPECT_TRUE(taken < kOne / kThree + Enclosure192(0x1p-180));
  EXPECT_EQ(to_64_bits(Enclosure192(Enclosure(2.5))).rad(), 0);
}

}  // namespace
}  // namespace forceshade::reference
