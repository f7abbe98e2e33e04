// SPDX-License-Identifier: BSD-3-Clause
#include "fast/simd/batch.h"
#include "forceshade/fast.h"
#include "tests/laws/law_suite.h"

using namespace forceshade;

FORCESHADE_LAW_SUITE(bump_2p)

TEST(bump_2p, keeps_every_bit_of_a_position_far_smaller_than_the_bump) {
  // w/2 - |x| takes 67 bits here: an exact stage that forms it in binary64 is wrong in the last place.
  const Parameters p{0x1.90019p+12F, 0x1.80018p+13F, 0x1.22p+0F};
  const Eigen::Vector3f position(0x1.000002p-29F, 0, -0x1.800002p-30F);
  const auto fast = std::get<fast::Law>(fast::Law::build(LawId::bump_2p, p));
  EXPECT_EQ(fast.force(position).z(), 0x1.050104p+12F);
  const auto reference = std::get<reference::Law>(reference::Law::build(LawId::bump_2p, p));
  EXPECT_EQ(fast.force(position), reference.round_to_binary32(position).force);
}

TEST(bump_2p, answers_one_odd_position_in_a_block_as_the_scalar_call_does) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), beyond = std::nextafter(1e4F, 2e4F), tiny = 0x1.fffffep-31F;
  for (std::size_t place = 0; place < fast::kBlock; ++place)
    for (const float odd : {nan, beyond, -beyond, tiny, -tiny, 0x1p-30F, -0x1p-30F, 1e4F, -1e4F, 0.0F, -0.0F, 3.0F})
      for (const float plain : {-1.0F, 1.0F}) {
        tests::expect_batch_answers(LawId::bump_2p, {3.125F, 6, 1}, {plain, 0, odd}, place);
        tests::expect_batch_answers(LawId::bump_2p, {3.125F, 6, 1}, {odd, 0, plain}, place);
        tests::expect_batch_answers(LawId::bump_2p, {3.125F, 6, 1}, {plain, odd, -1}, place);
      }
}

TEST(bump_2p, answers_one_tie_or_touch_in_a_block_as_the_scalar_call_does) {
  const auto expect = [](const Parameters& p, const Eigen::Vector3f& position, std::size_t place) {
    ASSERT_NE(std::get<fast::Law>(fast::Law::build(LawId::bump_2p, p)).evaluate(position).stage, fast::Stage::binary64);
    tests::expect_batch_answers(LawId::bump_2p, p, position, place);
  };
  for (std::size_t place = 0; place < fast::kBlock; ++place) {
    const auto odd = static_cast<float>(2 * place + 1);
    // The normal is (3/5, 4/5), the gap 5m. K = 129/128: F_x = 387m/128 is a tie, F_z = 129m/32 is not. K = 11/8: F_z = 11m/2
    // is a tie, F_x = 33m/8 is not. Each in binary64 is a little off, so that half of them would round the wrong way.
    expect({3.125F, 6, 1.0078125F}, {0, 0, 2.25F - 5 * (1 + odd * 0x1p-16F)}, place);
    expect({3.125F, 6, 1.375F}, {0, 0, 2.25F - 5 * (1 + odd * 0x1p-21F)}, place);
    // On the edge, touching: binary64 finds a gap of 2^-91 mm.
    expect({0x1.2ebe7ep-1F, 0x1.01ce3ep-2F, 1}, {0x1.01ce3ep-3F, 0, 0}, place);
  }
}
