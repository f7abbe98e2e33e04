// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_cylinder)

TEST(bump_cylinder, is_the_sum_of_cylinder_and_wall_rounded_once) {
  const Parameters p{15.24F, 25.4F, 0.5F};
  const auto sum = std::get<reference::Law>(reference::Law::build(LawId::bump_cylinder, p));
  const auto cylinder = std::get<reference::Law>(reference::Law::build(LawId::cylinder, p));
  const auto fast = std::get<fast::Law>(fast::Law::build(LawId::bump_cylinder, p));
  int rounded_twice_differs = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f position(-14.0F + 0.0137F * static_cast<float>(i), 0, -0.5F - 0.001F * static_cast<float>(i));
    const float twice = cylinder.round_to_binary32(position).force.z() + 0.5F * -position.z();
    EXPECT_EQ(fast.force(position), sum.round_to_binary32(position).force);
    rounded_twice_differs += fast.force(position).z() != twice;
  }
  EXPECT_GT(rounded_twice_differs, 0) << "otherwise this test could not fail";
}

TEST(bump_cylinder, can_push_down_below_the_axis) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_cylinder, {15.24F, 25.4F, 0.5F}));
  EXPECT_LT(law.force({0, 0, -8.5F}).z(), 0);
  EXPECT_GT(law.force({0, 0, -23}).z(), 0) << "deep down only a little of the cylinder is left, and the wall wins";
}
