// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_3p_shaded)

TEST(bump_3p_shaded, keeps_the_direction_across_the_edges_of_the_top) {
  // The gain of force shading: bump-3p's direction jumps by θ at |x| = w'/2, the shaded one does not.
  const Parameters p{12.7F, 25.4F, 1};
  const float edge = 6.35F, beyond = std::nextafter(edge, 7.0F);
  const auto direction = [&](LawId id, float x) {
    return std::get<fast::Law>(fast::Law::build(id, p)).force({x, 0, 0}).normalized().eval();
  };
  EXPECT_LT((direction(LawId::bump_3p_shaded, edge) - direction(LawId::bump_3p_shaded, beyond)).norm(), 1e-6F);
  EXPECT_GT((direction(LawId::bump_3p, edge) - direction(LawId::bump_3p, beyond)).norm(), 0.9F);
}
