// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_3p)

TEST(bump_3p, answers_an_exact_tie_on_a_flat_bump) {
  // h' - z is half way between two binary32 numbers, which only the widest stage can decide. Where w/2R <= 1/2, Newton's
  // method for t divides by negative numbers.
  const Parameters p{0x1.2bddap+12F, 0x1.0a96cp+12F, 1};
  const auto fast = std::get<fast::Law>(fast::Law::build(LawId::bump_3p, p));
  const auto reference = std::get<reference::Law>(reference::Law::build(LawId::bump_3p, p));
  const fast::Evaluation answer = fast.evaluate({1, 0, -0x1p-16F});
  EXPECT_EQ(answer.stage, fast::Stage::wide);
  EXPECT_EQ(answer.status, Status::contact);
  EXPECT_EQ(answer.force, reference.round_to_binary32({1, 0, -0x1p-16F}).force);
}

TEST(bump_3p, answers_a_block_beside_the_bump_as_the_scalar_call_does) {
  tests::expect_batch_answers(LawId::bump_3p, {0.1F, 0.2F, 1}, {5, 0, -1}, 0);
}
