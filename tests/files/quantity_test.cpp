// SPDX-License-Identifier: BSD-3-Clause
#include "files/quantity.h"

#include <gtest/gtest.h>

#include "forceshade/bad_input.h"

namespace forceshade::files {
namespace {

TEST(length, reads_every_unit_and_rounds_once) {
  EXPECT_EQ(parse_length("R", "15.24"), 15.24F);
  EXPECT_EQ(parse_length("R", "15.24mm"), 15.24F);
  EXPECT_EQ(parse_length("R", "15.24 mm"), 15.24F);
  EXPECT_EQ(parse_length("R", "600mil"), 15.24F);
  EXPECT_EQ(parse_length("R", "1in"), 25.4F);
  EXPECT_EQ(parse_length("R", "2.54cm"), 25.4F);
  EXPECT_EQ(parse_length("R", "0.0254m"), 25.4F);
  // Just above a tie between two binary32 numbers, by less than binary64 can see.
  EXPECT_EQ(parse_length("R", "1.00000005960464477539062500001"), std::nextafter(1.0F, 2.0F));
}

TEST(length, refuses_what_is_not_a_length) {
  for (const char* text : {"", "mm", "1 foot", "12,5", "1e999", "nan", "inf", "1mm2", "--3"})
    EXPECT_THROW(parse_length("--radius", text), BadInput) << text;
  try {
    parse_length("--radius", "1 foot");
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(),
                 "--radius: expected a length such as 15.24, 15.24mm, 600mil, 0.6in, 2.54cm or 0.01m, got \"1 foot\"");
  }
}

TEST(stiffness, reads_newtons_per_millimetre_or_metre) {
  EXPECT_EQ(parse_stiffness("K", "0.5"), 0.5F);
  EXPECT_EQ(parse_stiffness("K", "0.5N/mm"), 0.5F);
  EXPECT_EQ(parse_stiffness("K", "500N/m"), 0.5F);
  EXPECT_THROW(parse_stiffness("K", "0.5mm"), BadInput);
}

TEST(angle, reads_degrees_or_radians) {
  EXPECT_EQ(parse_angle("A", "30"), 30);
  EXPECT_EQ(parse_angle("A", "30deg"), 30);
  EXPECT_EQ(parse_angle("A", "-0.1 deg"), -0.1);
  EXPECT_EQ(parse_angle("A", "0.5rad"), 28.64788975654116);  // 0.5·180/π in bc, with 60 digits
  EXPECT_EQ(parse_angle("A", "0rad"), 0);
  for (const char* text : {"", "rad", "30mm", "1e999", "nan", "30°", "30degrees"})
    EXPECT_THROW(parse_angle("--turn", text), BadInput) << text;
}

}  // namespace
}  // namespace forceshade::files
