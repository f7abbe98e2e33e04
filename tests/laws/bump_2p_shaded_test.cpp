// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_2p_shaded)

TEST(bump_2p_shaded, has_the_magnitude_of_bump_2p_and_the_normal_of_the_cylinder) {
  // R = 3.125, w = 6: h = 2.25, H(x) = 2.25(1 - |x|/3). At x = 1.875 = 0.6 R, H = 0.84375 and the normal is (0.6, 0.8).
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_2p_shaded, {3.125F, 6, 1}));
  EXPECT_EQ(law.force({1.875F, 0, -0.15625F}), Eigen::Vector3f(0.6F, 0, 0.8F));
  EXPECT_EQ(law.force({0, 0, 1.25F}), Eigen::Vector3f(0, 0, 1)) << "on the ridge the shaded normal points straight up";
  EXPECT_EQ(law.evaluate({1.875F, 0, 0.84375F}).status, Status::free) << "on the surface";
}
