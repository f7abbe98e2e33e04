// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/sampled_wall.h"

#include <gtest/gtest.h>

namespace forceshade::device {
namespace {

// A held spring is late by half a sample on average, which is a damping of -KT/2.
TEST(sampled_wall, of_an_ideal_mass_goes_unstable_at_2b_over_T_within_2_per_cent) {
  for (const double damping : {0.1, 0.3, 1.0})
    for (const double period : {0.5e-3, 1e-3}) {
      const SampledWall wall{.damping = damping, .coulomb = 0, .quantum = 0, .period = period};
      const double found = largest_quiet_stiffness(wall), expected = 2 * damping / period;
      EXPECT_NEAR(found, expected, 0.02 * expected);
    }
}

// A sample of latency is late by one and a half.
TEST(sampled_wall, with_latency_goes_unstable_at_a_third_of_that_within_2_per_cent) {
  for (const double damping : {0.1, 0.3}) {
    const SampledWall wall{.damping = damping, .coulomb = 0, .quantum = 0, .latency = true};
    const double expected = damping / (1.5 * wall.period);
    EXPECT_NEAR(largest_quiet_stiffness(wall), expected, 0.02 * expected);
  }
}

// Each side of the border, on both of its branches and in their corner.
TEST(sampled_wall, is_quiet_up_to_the_border_of_abbott_and_okamura_within_10_per_cent) {
  int by_damping = 0, by_friction = 0;
  for (const double damping : {0.1, 0.25, 0.6, 1.5})
    for (const double coulomb : {0.0025, 0.006, 0.015, 0.04}) {
      const SampledWall wall{.damping = damping, .coulomb = coulomb};
      const double border = passive_stiffness(wall);
      ++(border == 2 * damping / wall.period ? by_damping : by_friction);
      EXPECT_TRUE(is_quiet(wall, 0.9 * border)) << damping << ' ' << coulomb << ' ' << border;
      EXPECT_FALSE(is_quiet(wall, 1.1 * border)) << damping << ' ' << coulomb << ' ' << border;
    }
  EXPECT_GE(by_damping, 4);
  EXPECT_GE(by_friction, 4);
}

// The figures of the paper for its devices: friction alone allows a Premium 2670 and an Omni 9450 N/m.
TEST(sampled_wall, with_friction_alone_allows_what_is_published) {
  EXPECT_NEAR(passive_stiffness({.damping = 100, .coulomb = 0.04, .quantum = 0.03e-3}), 2670, 5);
  EXPECT_NEAR(passive_stiffness({.damping = 100, .coulomb = 0.26, .quantum = 0.055e-3}), 9450, 5);
}

}  // namespace
}  // namespace forceshade::device
