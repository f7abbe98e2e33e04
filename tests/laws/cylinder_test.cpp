// SPDX-License-Identifier: BSD-3-Clause
#include "fast/simd/batch.h"
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(cylinder)

TEST(cylinder, pushes_up_with_all_its_strength_on_the_axis) {
  // R = 1.25 and w = 1.5 put the axis at z = -1 exactly.
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::cylinder, {1.25F, 1.5F, 2}));
  EXPECT_EQ(law.force({0, 0, -1}), Eigen::Vector3f(0, 0, 2.5F));
  EXPECT_LT(law.force({0, 0, -1.001F}).z(), 0) << "below the axis it pushes down";
}

TEST(cylinder, is_free_on_its_surface_and_touches_one_step_below) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::cylinder, {1.25F, 1.5F, 2}));
  EXPECT_EQ(law.evaluate({0, 0, 0.25F}).status, Status::free);
  EXPECT_EQ(law.evaluate({0, 0, std::nextafter(0.25F, 0.0F)}).status, Status::contact);
  EXPECT_EQ(law.evaluate({0.75F, 0, 0}).status, Status::free);
  EXPECT_EQ(law.evaluate({std::nextafter(0.75F, 0.0F), 0, 0}).status, Status::contact);
}

TEST(cylinder, answers_one_position_on_the_axis_in_a_block_as_the_scalar_call_does) {
  for (std::size_t place = 0; place < fast::kBlock; ++place)
    tests::expect_batch_answers(LawId::cylinder, {1.25F, 1.5F, 2}, {0, 0, -1}, place);
}
