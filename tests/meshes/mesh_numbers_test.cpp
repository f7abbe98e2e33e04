// SPDX-License-Identifier: BSD-3-Clause
// Numbers with a unit against rational arithmetic: each is rounded once.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>

#include "rendering/meshes/numbers.h"
#include "tests/support/rational.h"

namespace forceshade::mesh {
namespace {

constexpr std::array<Unit, 4> kUnits{Unit::mm, Unit::cm, Unit::m, Unit::in};

// The binary32 number nearest to number times unit, ties to even.
float nearest(const mpq_class& number, Unit unit) {
  const mpq_class factor = unit == Unit::in ? mpq_class(127, 5)
                                            : mpq_class(unit == Unit::mm   ? 1
                                                        : unit == Unit::cm ? 10
                                                                           : 1000);
  return tests::nearest<float>(number * factor);
}

// A number of digits with a point in them, and an exponent.
mpq_class rational(const std::string& digits, int behind_point, int exponent, bool is_negative) {
  const mpq_class result = tests::decimal(digits, exponent - behind_point);
  return is_negative ? mpq_class(-result) : result;
}

TEST(mesh_numbers, as_decimals_are_rounded_once_in_every_unit) {
  std::mt19937_64 random(7);
  std::uint64_t cases = 0, twice = 0;
  for (int i = 0; i < 60000; ++i) {
    std::string digits;
    const auto length = 1 + random() % (i % 20 == 0 ? 120 : 22);
    for (std::size_t k = 0; k < length; ++k) digits += static_cast<char>('0' + random() % 10);
    const auto behind = static_cast<int>(random() % (length + 1));
    const int exponent = static_cast<int>(random() % 60) - 40;
    const bool is_negative = random() % 2 == 0;
    const bool has_exponent = random() % 3 != 0;
    std::string text(is_negative ? "-" : random() % 5 == 0 ? "+" : "");
    text.append(digits, 0, length - static_cast<std::size_t>(behind));
    if (behind > 0 || random() % 4 == 0) text += '.';
    text.append(digits, length - static_cast<std::size_t>(behind));
    if (has_exponent) {
      text += random() % 2 == 0 ? 'e' : 'E';
      if (exponent >= 0 && random() % 2 == 0) text += '+';
      text.append(std::to_string(exponent));
    }
    const mpq_class number = rational(digits, behind, has_exponent ? exponent : 0, is_negative);
    for (const Unit unit : kUnits) {
      const auto got = from_decimal(text, unit);
      ASSERT_TRUE(got.has_value()) << text;
      ASSERT_EQ(*got, nearest(number, unit)) << text << " in " << kUnitNames[static_cast<std::size_t>(unit)];
      ++cases;
      twice +=
          unit == Unit::in && *got != static_cast<float>(static_cast<double>(*from_decimal(text, Unit::mm)) * 25.4) ? 1 : 0;
    }
  }
  std::printf("%llu numbers; rounding inches twice would be wrong for %llu\n", static_cast<unsigned long long>(cases),
              static_cast<unsigned long long>(twice));
  EXPECT_GT(twice, 100U);
}

// A point of a texture: a decimal number, or one of binary64, times a length that is typed.
TEST(mesh_numbers, of_a_texture_are_rounded_once_in_every_unit) {
  std::mt19937_64 random(11);
  int twice = 0;
  for (const auto& [text, unit] : {std::pair("25.4", mpq_class(127, 5)),
                                   {"0.3", mpq_class(3, 10)},
                                   {"1", mpq_class(1)},
                                   {"7.00000000000000000001", tests::decimal("700000000000000000001", -20)}}) {
    const files::Decimal scale = *files::Decimal::of(text);
    for (int i = 0; i < 4000; ++i) {
      const tests::NearTie one = tests::near_tie(random, unit);
      const auto expected = tests::nearest<float>(one.number * unit);
      ASSERT_EQ(from_decimal(one.text, scale), expected) << one.text << " in " << text;
      const double as_binary = std::stod(one.text);
      ASSERT_EQ(from_binary(as_binary, scale), tests::nearest<float>(mpq_class(as_binary) * unit))
          << one.text << " in " << text;
      if (std::stof(one.text) * scale.nearest<float>() != expected) ++twice;
    }
  }
  std::printf("  %d of 16000 would be wrong if rounded twice\n", twice);
  EXPECT_GT(twice, 1000);
}

TEST(mesh_numbers, as_binary_numbers_are_rounded_once_in_every_unit) {
  std::mt19937_64 random(8);
  std::uint64_t cases = 0;
  for (int i = 0; i < 200000; ++i) {
    const double wide = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 60) - 90);
    const double number = i % 2 == 0 ? static_cast<double>(static_cast<float>(wide)) : -wide;
    for (const Unit unit : kUnits) {
      ASSERT_EQ(from_binary(number, unit), nearest(mpq_class(number), unit)) << number;
      ++cases;
    }
  }
  // Next to midway between two binary32 numbers of mm: a number of 25 bits, the last one 1, is not one of them.
  for (int i = 0; i < 20000; ++i) {
    const auto midway = static_cast<double>((random() & 0x7FFFFFU) * 2 + 0x1000001U);
    for (const double x : {midway / 10, midway / 1000, midway * 5 / 127})
      for (const double number : {std::nextafter(x, 0.0), x, std::nextafter(x, 1e9)})
        for (const Unit unit : kUnits) {
          ASSERT_EQ(from_binary(number, unit), nearest(mpq_class(number), unit)) << number;
          ++cases;
        }
  }
  std::printf("%llu numbers\n", static_cast<unsigned long long>(cases));
}

TEST(mesh_numbers, may_be_too_large_or_too_small_for_binary32_and_are_no_less_numbers) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Unit unit : kUnits) {
    for (const char* large : {"1e39", "1e400", "1e99999999999999999999", "123456789012345678901234567890123456789012", "1e+50"})
      EXPECT_EQ(from_decimal(large, unit), kInfinity) << large;
    EXPECT_EQ(from_decimal("-1e400", unit), -kInfinity);
    for (const char* small :
         {"1e-60", "1e-400", "1e-99999999999999999999", "0e999999", "0", "-0", "0.000", "-1e-400", "0e-5", ".0"})
      EXPECT_EQ(from_decimal(small, unit), 0.0F) << small;
    for (const char* none :
         {"", "+", "-", ".", "e5", "1e", "1e+", "1.5.2", "0x10", "1f", " 1", "1 ", "--1", "+-1", "-+1", "++1", "1,5", "one"})
      EXPECT_EQ(from_decimal(none, unit), std::nullopt) << none;
    for (const char* endless : {"inf", "-inf", "infinity", "1e4000"})
      EXPECT_TRUE(std::isinf(from_decimal(endless, unit).value())) << endless;
    EXPECT_TRUE(std::isnan(from_decimal("nan", unit).value()));
    EXPECT_TRUE(std::isnan(from_binary(std::nan(""), unit)));
    EXPECT_EQ(from_binary(1e300, unit), kInfinity);
    EXPECT_EQ(from_binary(0.0, unit), 0.0F);
  }
  EXPECT_EQ(from_decimal("1", Unit::cm), 10.0F);
  EXPECT_EQ(from_decimal("1", Unit::m), 1000.0F);
  EXPECT_EQ(from_decimal("1", Unit::in), 25.4F);
  EXPECT_EQ(from_binary(1, Unit::in), 25.4F);
  EXPECT_EQ(from_decimal("1.", Unit::in), 25.4F);
  EXPECT_EQ(from_decimal(".5e1", Unit::m), 5000.0F);
}

}  // namespace
}  // namespace forceshade::mesh
