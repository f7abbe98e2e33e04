// SPDX-License-Identifier: BSD-3-Clause
// The velocity of damping: ties, numbers beside them, and the slowest one.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "fast/damping/filter.h"
#include "tests/damping/both_sides.h"

namespace forceshade {
namespace {

// Numbers of which one on the way has more than 53 bits are not sure: NaN here.
TEST(damping, only_short_numbers_decide_a_velocity_without_a_bound) {
  struct Numbers {
    double keep, gain;
    bool is_short;
  };
  const auto velocity = [](float v, float x, float before, float rate, float share, bool is_short = true) {
    const auto one = [](float a) { return fast::Quad(fast::Pair64{double{a}, 0}, fast::Pair64{}); };
    const Numbers numbers{1 - double{share}, double{share} * double{rate}, is_short};
    const fast::Rounded found = fast::filtered_velocity(one(v), one(x), one(before), numbers);
    return found.is_sure() ? found.value[0] : NAN;
  };
  // (v + 1000·2^-9)/2 with the last bit of v at 2^-23: a tie, to the even neighbour.
  const float even = (1 + 1000 * 0x1p-9F) / 2;
  EXPECT_EQ(velocity(1 + 0x1p-23F, 1 + 0x1p-9F, 1, 1000, 0.5F), even);
  EXPECT_EQ(velocity(1 + 0x1.8p-22F, 1 + 0x1p-9F, 1, 1000, 0.5F), even + 0x1p-22F);
  EXPECT_TRUE(std::isnan(velocity(1 + 0x1p-22F, 1 + 0x1p-9F, 1, 1000, 0.75F, false))) << "α is no power of two";
  EXPECT_TRUE(std::isnan(velocity(0, 8192, 0x1p-12F, 1, 1))) << "x - x⁻ has more bits than a binary32";
  EXPECT_TRUE(std::isnan(velocity(0x1.000002p-20F, 8192 + 0x1p-10F, 0, 98304, 0.5F))) << "a bit of what is kept is lost";
  EXPECT_TRUE(std::isnan(velocity(0x1p32F, 256 - 0x1p-15F, 0, 1 + 0x1p-23F, 0.5F))) << "a bit of what is gained is lost";
  EXPECT_EQ(velocity(1, 1e4F, -1e4F, 131072, 1), 20000 * 131072.0F);
}

// In binary64 αru is a tie, since it is rounded. Its 72 bits end beside the tie, away from the even number.
TEST(damping, a_velocity_beside_a_tie_is_no_tie_unless_the_share_is_a_power_of_two) {
  struct Row {
    float rate, share, x, velocity;
  };
  for (const Row& row : {Row{0x1.d78592p+16F, 0x1.57ff06p-1F, 0x1.b74366p-1F, 0x1.0fcb56p+16F},
                         Row{0x1.6d479cp+16F, 0x1.eb6de2p-1F, 0x1.ab07b2p-1F, 0x1.246b2ep+16F}}) {
    tests::DampingOfBothSides both({.rate = row.rate, .share = row.share, .damping = 1});
    both.tick({0, 0, 0}, 1, {0, 0, 1});
    both.tick({0, 0, row.x}, 1, {0, 0, 1});
    EXPECT_EQ(both.fast.state().velocity[2], row.velocity);
  }
}

TEST(damping, the_slowest_velocity_is_kept) {
  tests::DampingOfBothSides both({.rate = 1, .share = 0.5F, .damping = 1});
  for (const auto& [way, velocity] : {std::pair{0x1p-19F, 0x1p-20F}, {0x1.fffffep-20F, 0.0F}}) {
    both.resume({true, {0, 0, 0}, {0, 0, 0}, 0});
    both.tick({0, 0, way}, 1, {0, 0, 1});
    EXPECT_EQ(both.reference.state().velocity[2], velocity);
  }
}

}  // namespace
}  // namespace forceshade
