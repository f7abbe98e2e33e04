// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace forceshade::conformance {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kSmallest = std::numeric_limits<float>::denorm_min(), kLargest = std::numeric_limits<float>::max();

const Digits kNone = [](unsigned) { return std::nullopt; };

reference::Rounded contact(const Eigen::Vector3f& force) {
  reference::Rounded rounded;
  rounded.force = force;
  rounded.status = Status::contact;
  return rounded;
}

TEST(ulps, count_the_binary32_numbers_from_one_to_the_other) {
  EXPECT_EQ(ulps_between(1, 1), 0U);
  EXPECT_EQ(ulps_between(0.0F, -0.0F), 0U);
  EXPECT_EQ(ulps_between(1, std::nextafter(1.0F, 2.0F)), 1U);
  EXPECT_EQ(ulps_between(1, std::nextafter(1.0F, 0.0F)), 1U);
  EXPECT_EQ(ulps_between(kSmallest, -kSmallest), 2U);
  EXPECT_EQ(ulps_between(1, 2), 1U << 23U);
  EXPECT_EQ(ulps_between(kLargest, -kLargest), 2 * 0x7f7fffffULL);
}

TEST(distance, is_the_largest_in_ulp_and_the_length_in_newton) {
  const reference::Rounded exact = contact({3, 0, 4});
  const Distance found = distance({std::nextafter(3.0F, 4.0F), 0, 4.5F}, exact);
  EXPECT_EQ(found.ulps, ulps_between(4, 4.5F));
  EXPECT_LE(found.newtons.low, 0.5);
  EXPECT_GE(found.newtons.high, 0.5);
  EXPECT_NEAR(found.newtons.high, 0.5, 1e-6);
  EXPECT_NEAR(found.exact_newtons.low, 5, 1e-6);
  for (const float none : {kNan, kInfinity, -kInfinity}) EXPECT_EQ(distance({3, none, 4}, exact).ulps, kNoNumber);
}

// 0.5 N, exactly, as of a wall: the distance in N is a number of binary64, and that one is still within.
TEST(is_within, decides_a_distance_that_equals_the_tolerance) {
  const Eigen::Vector3f answer(0, 0, 0.5F + 0x1p-20F);
  const reference::Rounded exact = contact({0, 0, 0.5F});
  const Digits half = [](unsigned) { return std::optional<std::array<std::string, 3>>{{"0", "0", "0.5"}}; };
  EXPECT_TRUE(is_within({Unit::newton, 0x1p-20}, answer, exact, half));
  EXPECT_FALSE(is_within({Unit::newton, std::nextafter(0x1p-20, 0.0)}, answer, exact, half));
  EXPECT_TRUE(is_within({Unit::percent, 100 * 0x1p-19}, answer, exact, half));
  EXPECT_FALSE(is_within({Unit::percent, std::nextafter(100 * 0x1p-19, 0.0)}, answer, exact, half));
  EXPECT_TRUE(is_within({Unit::ulp, 16}, answer, exact, half));
  EXPECT_FALSE(is_within({Unit::ulp, 15}, answer, exact, half));
}

// Answers that are off by just so much as a decimal tolerance allows, of exact forces of 1000 and 1000000 N; a hair less is
// less.
TEST(is_within, decides_a_decimal_tolerance_exactly) {
  int cases = 0;
  for (const float size : {1000.0F, 1000000.0F})
    for (int tenths = 1; tenths <= 400; ++tenths) {
      const auto answer = static_cast<float>(static_cast<double>(size) + static_cast<double>(size) / 1000 * tenths);
      const reference::Rounded exact = contact({0, 0, size});
      const auto digits_of_force = [size](unsigned) {
        return std::optional<std::array<std::string, 3>>{{"0", "0", std::to_string(static_cast<long>(size))}};
      };
      const std::string percent = std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10);
      const std::string newtons = std::to_string(tenths) + (size == 1000 ? "" : "000");
      const files::Decimal less = *files::Decimal::of("0.999999999999999999999999999999");
      for (const auto& [text, unit] : {std::pair(percent, Unit::percent), {newtons, Unit::newton}})
        for (const Digits& digits : {Digits(digits_of_force), kNone}) {
          const Tolerance just{unit, *files::Decimal::of(text)}, hair_less{unit, just.value * less};
          EXPECT_TRUE(is_within(just, {0, 0, answer}, exact, digits)) << text << words_of(just);
          EXPECT_FALSE(is_within(hair_less, {0, 0, answer}, exact, digits)) << text << words_of(just);
          ++cases;
        }
    }
  std::printf("  %d cases\n", cases);
  EXPECT_GT(cases, 3000);
}

// The binary32 nearest to the exact force is not exact: its own error counts in N.
TEST(is_within, takes_the_exact_force_and_not_the_rounded_one) {
  const auto law = std::get<reference::Law>(reference::Law::build(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));
  const Eigen::Vector3f position(3, 0, -0.5F);
  const reference::Rounded exact = law.round_to_binary32(position);
  const Digits digits = [&](unsigned count) {
    const auto force = law.decimal(position, count);
    return std::optional<std::array<std::string, 3>>{{force.x, "0", force.z}};
  };
  // Its distance, from digits beyond those of binary64's differences.
  const auto off = [&](float rounded, const std::string& text) {
    return std::strtold(text.c_str(), nullptr) - static_cast<long double>(rounded);
  };
  const auto texts = *digits(30);
  const long double size = std::hypot(off(exact.force.x(), texts[0]), off(exact.force.z(), texts[2]));
  ASSERT_GT(size, 1e-10L);
  EXPECT_FALSE(is_within({Unit::newton, static_cast<double>(size * (1 - 1e-8L))}, exact.force, exact, digits));
  EXPECT_TRUE(is_within({Unit::newton, static_cast<double>(size * (1 + 1e-8L))}, exact.force, exact, digits));
  EXPECT_FALSE(is_within({Unit::newton, 0}, exact.force, exact, digits));
  const long double whole = std::hypot(std::strtold(texts[0].c_str(), nullptr), std::strtold(texts[2].c_str(), nullptr));
  EXPECT_FALSE(is_within({Unit::percent, static_cast<double>(100 * size / whole * (1 - 1e-8L))}, exact.force, exact, digits));
  EXPECT_TRUE(is_within({Unit::percent, static_cast<double>(100 * size / whole * (1 + 1e-8L))}, exact.force, exact, digits));
}

TEST(is_within, requires_zero_of_an_exact_zero_in_percent_and_a_number_in_all) {
  const reference::Rounded none;
  EXPECT_TRUE(is_within({Unit::percent, 50}, {0, -0.0F, 0}, none, kNone));
  EXPECT_FALSE(is_within({Unit::percent, 1e9}, {0, kSmallest, 0}, none, kNone));
  EXPECT_TRUE(is_within({Unit::newton, 1e-3}, {0, 1e-3F, 0}, none, kNone) == (double{1e-3F} <= 1e-3));
  for (const Unit unit : {Unit::ulp, Unit::newton, Unit::percent}) {
    EXPECT_FALSE(is_within({unit, 0x1p32}, {0, kNan, 0}, none, kNone));
    EXPECT_FALSE(is_within({unit, 0x1p32}, {0, kInfinity, 0}, contact({0, kLargest, 0}), kNone));
  }
}

TEST(tolerance, is_a_number_with_its_unit) {
  for (const auto& [text, unit, value, words] : {std::tuple{"4 ulp", Unit::ulp, 4.0, "4 ulp"},
                                                 {"0ulp", Unit::ulp, 0.0, "correctly rounded"},
                                                 {"1e-6 N", Unit::newton, 1e-6, "1e-06 N"},
                                                 {"0N", Unit::newton, 0.0, "0 N"},
                                                 {"4294967296 ulp", Unit::ulp, 0x1p32, "4294967296 ulp"}}) {
    const auto found = tolerance_of(text);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(found->unit, unit) << text;
    EXPECT_EQ(found->value.nearest<double>(), value) << text;
    EXPECT_EQ(words_of(*found), words);
  }
}

// 0.1 is no binary number.
TEST(tolerance, is_the_decimal_that_was_typed) {
  for (const auto& [text, value] :
       {std::pair("0.1 %", "0.1"), {"0.3%", "0.3"}, {"0.10000000000000000000001 N", "0.10000000000000000000001"}}) {
    const auto found = tolerance_of(text);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(found->value, *files::Decimal::of(value)) << text;
    EXPECT_EQ(words_of(*found).substr(0, words_of(*found).find(' ')), value);
  }
}

TEST(tolerance, is_refused_where_it_is_anything_else) {
  for (const char* text : {"", "4", "ulp", "1.5 ulp", "-1 ulp", "-0 N", "nan N", "inf N", "1e999 N", "1 mN", "1 N ", "1 n",
                           "4294967297 ulp", "1.00000000000000000000001 ulp", "1e-400 N", "+1 N", " 1 N", "0x1p-3 N"})
    EXPECT_FALSE(tolerance_of(text)) << text;
}

}  // namespace

}  // namespace forceshade::conformance
