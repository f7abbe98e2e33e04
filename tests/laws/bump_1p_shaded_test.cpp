// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_1p_shaded)

TEST(bump_1p_shaded, turns_the_force_of_the_flat_plane) {
  // 3-4-5: at x = 3 on R = 5 the normal is (0.6, 0.8).
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_1p_shaded, {5, 8, 1}));
  EXPECT_EQ(law.force({3, 0, -1}), Eigen::Vector3f(0.6F, 0, 0.8F));
  EXPECT_EQ(law.force({-3, 0, -1}), Eigen::Vector3f(-0.6F, 0, 0.8F));
  EXPECT_EQ(law.force({0, 0, -1}), Eigen::Vector3f(0, 0, 1));
}

TEST(bump_1p_shaded, shades_up_to_the_edge_and_not_beyond) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_1p_shaded, {5, 8, 1}));
  EXPECT_EQ(law.force({4, 0, -1}), Eigen::Vector3f(0.8F, 0, 0.6F));
  EXPECT_EQ(law.force({std::nextafter(4.0F, 5.0F), 0, -1}), Eigen::Vector3f(0, 0, 1));
}
