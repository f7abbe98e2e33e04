// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(wall)

TEST(wall, pushes_straight_up_by_stiffness_times_depth) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {0, 0, 0.5F}));
  EXPECT_EQ(law.force({3, 4, -2}), Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(law.evaluate({3, 4, 0}).status, Status::free);
  EXPECT_EQ(law.evaluate({3, 4, 1}).status, Status::free);
}

TEST(wall, rounds_an_exact_tie_to_even) {
  // (2^23 + 1)·(1 + 2^-1)·2^-22 has 25 significant bits, the last one set: half way between two binary32 numbers.
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {0, 0, 1.5F}));
  const float z = -8388609.0F * 0x1p-22F;
  const double exact = 1.5 * -static_cast<double>(z);
  const float below = std::nextafter(static_cast<float>(exact), 0.0F);
  ASSERT_TRUE(exact == 0.5 * (static_cast<double>(below) + static_cast<double>(std::nextafter(below, 9.0F))) ||
              exact == 0.5 * (static_cast<double>(std::nextafter(below, 9.0F)) +
                              static_cast<double>(std::nextafter(std::nextafter(below, 9.0F), 9.0F))));
  EXPECT_EQ(std::bit_cast<unsigned>(law.force({0, 0, z}).z()) & 1U, 0U);
}
