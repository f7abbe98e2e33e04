// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "properties/positions.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_1p)

TEST(bump_1p, is_the_wall) {
  const Parameters p{15.24F, 25.4F, 0.7F};
  const auto bump = std::get<fast::Law>(fast::Law::build(LawId::bump_1p, p));
  const auto wall = std::get<fast::Law>(fast::Law::build(LawId::wall, p));
  properties::PositionSource source(std::get<reference::Law>(reference::Law::build(LawId::bump_1p, p)), 5);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3f position = source.next().position;
    EXPECT_EQ(bump.force(position), wall.force(position));
  }
}
