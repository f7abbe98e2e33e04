// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/tolerance.h"

#include <gtest/gtest.h>

namespace forceshade::conformance {
namespace {

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
