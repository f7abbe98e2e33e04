// SPDX-License-Identifier: BSD-3-Clause
#include "fast/simd/batch.h"
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(cylinder)

TEST(cylinder, answers_one_position_on_the_axis_in_a_block_as_the_scalar_call_does) {
  for (std::size_t place = 0; place < fast::kBlock; ++place)
    tests::expect_batch_answers(LawId::cylinder, {1.25F, 1.5F, 2}, {0, 0, -1}, place);
}
