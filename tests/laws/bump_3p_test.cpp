// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_3p)

TEST(bump_3p, gives_an_edge_that_is_a_binary32_to_the_top) {
  // w = 2R: w'/2 = R/2. R = 1, w = 1.375: w'/2 = 1/4.
  for (const auto& [R, w, edge] : {std::array{12.7F, 25.4F, 6.35F}, std::array{1.0F, 1.375F, 0.25F}}) {
    const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_3p, {R, w, 1}));
    EXPECT_EQ(law.force({edge, 0, 0}).x(), 0) << "on the top";
    EXPECT_EQ(law.force({-edge, 0, 0}).x(), 0);
    EXPECT_GT(law.force({std::nextafter(edge, R), 0, 0}).x(), 0) << "on the right face";
    EXPECT_LT(law.force({-std::nextafter(edge, R), 0, 0}).x(), 0) << "on the left face";
  }
}

TEST(bump_3p, has_rational_faces_where_the_cubic_has_a_rational_root) {
  // t = 5/13: sin θ = 120/169, cos θ = 119/169, w' = 2R·5/13, h' = w' sin θ.
  const Parameters p{2197.0F / 1024, 2035.0F / 512, 1};
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_3p, p));
  const double w_prime = 2 * 2197.0 / 1024 * 5 / 13, h_prime = w_prime * 120 / 169;
  EXPECT_EQ(law.force({0, 0, 0}).z(), static_cast<float>(h_prime));
  const double x = 1.5, gap = 120.0 / 119 * (2035.0 / 1024 - x) + 0.25;
  EXPECT_FLOAT_EQ(law.force({static_cast<float>(x), 0, -0.25F}).x(), static_cast<float>(gap * 120 / 169));
  EXPECT_FLOAT_EQ(law.force({static_cast<float>(x), 0, -0.25F}).z(), static_cast<float>(gap * 119 / 169));
}

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
