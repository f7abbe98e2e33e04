// SPDX-License-Identifier: BSD-3-Clause
#include "files/quantity.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "forceshade/error.h"
#include "tests/support/rational.h"
#include "tests/support/words.h"

namespace forceshade::files {
namespace {

TEST(length, refuses_what_is_not_a_length) {
  for (const char* text : {"", "mm", "1 foot", "12,5", "1e999", "nan", "inf", "1mm2", "--3"})
    EXPECT_THROW(parse_length("--radius", text), Error) << text;
  EXPECT_EQ(tests::thrown_by<Error>([&] { parse_length("--radius", "1 foot"); }),
            "--radius: expected a length such as 15.24, 15.24mm, 600mil, 0.6in, 2.54cm or 0.01m, got \"1 foot\"");
}

// Decimals of 12 to 19 digits beside middles between two numbers of binary32.
TEST(quantity, is_rounded_once_in_every_unit) {
  EXPECT_EQ(parse_length("R", "600mil"), 15.24F);
  EXPECT_THROW(parse_stiffness("K", "0.5mm"), Error);
  std::mt19937_64 random(8);
  struct Case {
    float (*parse)(const std::string& name, const std::string& text);
    const char* unit;
    mpq_class size;
  };
  for (const Case& one :
       {Case{&parse_length, "", 1}, Case{&parse_length, "mm", 1}, Case{&parse_length, "mil", {127, 5000}},
        Case{&parse_length, "in", {127, 5}}, Case{&parse_length, "cm", 10}, Case{&parse_length, "m", 1000},
        Case{&parse_stiffness, "", 1}, Case{&parse_stiffness, "N/mm", 1}, Case{&parse_stiffness, "N/m", {1, 1000}}}) {
    int twice = 0;
    for (int i = 0; i < 4000; ++i) {
      const tests::NearTie typed = tests::near_tie(random, one.size);
      const auto expected = tests::nearest<float>(typed.number * one.size);
      ASSERT_EQ(one.parse("N", typed.text + one.unit), expected) << typed.text << one.unit;
      ASSERT_EQ(one.parse("N", '-' + typed.text + ' ' + one.unit), -expected) << typed.text << one.unit;
      if (static_cast<float>(std::stod(typed.text) * one.size.get_d()) != expected) ++twice;
    }
    std::printf("  %-5s %d of 4000 would be wrong by way of binary64\n", one.unit, twice);
    EXPECT_GT(twice, 100);
  }
}

TEST(quantity, is_never_infinite_and_a_tiny_one_is_zero) {
  for (const char* text : {"1e36m", "3.4028236e38", "1e400", "-1e38in"}) EXPECT_THROW(parse_length("R", text), Error) << text;
  EXPECT_EQ(parse_length("R", "1e-60m"), 0.0F);
  EXPECT_EQ(parse_length("R", "1e-99999999999999999999"), 0.0F);
  EXPECT_TRUE(std::signbit(parse_length("R", "-0in")));
}

TEST(decimal, is_exact) {
  const auto of = [](const char* text) { return *Decimal::of(text); };
  for (const auto& [text, shown, fraction] : {std::tuple{"25.40", "25.4", "2540/100"},
                                              {"-1e2", "-100", "-100/1"},
                                              {"0.0000001", "0.0000001", "1/10000000"},
                                              {"1e-9", "1e-9", "1/1000000000"},
                                              {"-0", "-0", "-0/1"},
                                              {"120e7", "12e8", "1200000000/1"},
                                              {".5", "0.5", "5/10"},
                                              {"0e9", "0", "0/1"}}) {
    EXPECT_EQ(of(text).text(), shown) << text;
    EXPECT_EQ(of(text).fraction(), fraction) << text;
    EXPECT_EQ(of(of(text).text().c_str()), of(text));
  }
  EXPECT_EQ((of("0.0254") * of("1000")).text(), "25.4");
  EXPECT_EQ((of("-99999999999999999999") * of("99999999999999999999")).text(), "-9999999999999999999800000000000000000001");
  EXPECT_EQ(of("1.0"), of("10e-1"));
  EXPECT_FALSE(of("1") == of("-1"));
  EXPECT_TRUE(of("1.50e1").is_whole() && of("0.00").is_whole());
  EXPECT_FALSE(of("1.5").is_whole());
  for (const char* none : {"", "nan", "inf", "+1", " 1", "1 ", "1e", "0x1p3", "1,5"}) EXPECT_FALSE(Decimal::of(none)) << none;
  EXPECT_TRUE(Decimal(1).is_one() && of("1").is_one());
  EXPECT_FALSE(Decimal(10).is_one() || of("-1").is_one() || of("0.1").is_one());
  EXPECT_EQ(Decimal(0.375).text(), "0.375");
  // About the number from which on not every whole one is in binary64.
  for (const auto& [number, text] : {std::pair{0x1p52, "4503599627370496"},
                                     {0x1p53, "9007199254740992"},
                                     {0x1p53 + 2, "9007199254740994"},
                                     {0x1p54, "18014398509481984"}})
    EXPECT_EQ(Decimal(number), of(text)) << text;
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    ASSERT_EQ(Decimal(number).nearest<double>(), number);
    mpq_class fraction(Decimal(number).fraction());
    fraction.canonicalize();
    ASSERT_EQ(fraction, mpq_class(number));
  }
}

TEST(angle, in_radians_is_rounded_once) {
  std::mt19937_64 random(5);
  mpfr_t degrees;
  mpfr_init2(degrees, 2000);
  for (int i = 0; i < 4000; ++i) {
    const tests::NearTie typed = tests::near_tie(random, 1);
    mpfr_const_pi(degrees, MPFR_RNDN);
    mpfr_ui_div(degrees, 180, degrees, MPFR_RNDN);
    mpfr_mul_q(degrees, degrees, typed.number.get_mpq_t(), MPFR_RNDN);
    ASSERT_EQ(parse_angle("A", typed.text + "rad"), mpfr_get_d(degrees, MPFR_RNDN)) << typed.text;
  }
  mpfr_clear(degrees);
}

TEST(angle, reads_degrees_or_radians) {
  EXPECT_EQ(parse_angle("A", "30"), 30);
  EXPECT_EQ(parse_angle("A", "30deg"), 30);
  EXPECT_EQ(parse_angle("A", "-0.1 deg"), -0.1);
  EXPECT_EQ(parse_angle("A", "0.5rad"), 28.64788975654116);  // 0.5·180/π in bc, with 60 digits
  EXPECT_EQ(parse_angle("A", "0rad"), 0);
  for (const char* text : {"", "rad", "30mm", "1e999", "1e308rad", "nan", "30°", "30degrees"})
    EXPECT_THROW(parse_angle("--turn", text), Error) << text;
}

}  // namespace
}  // namespace forceshade::files
