// SPDX-License-Identifier: BSD-3-Clause
// A hand on a virtual wall under loops of all rates: the energy that it is given, and the words about it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "device/null.h"
#include "device/passive_rate.h"
#include "device/simulated/simulated.h"
#include "tests/device/hand_on_wall.h"

namespace forceshade::device {
namespace {

Capabilities capabilities_of(const Model& model) {
  return Simulated(model, std::nullopt).capabilities();
}

std::string words_of(const HandOnWall& wall, const FeltOnWall& felt) {
  return std::string(wall.model.name) + ", " + std::string(name_of(wall.passivity)) + ", " +
         (wall.presses ? "presses" : "strokes") + ", " + std::to_string(wall.rate) + " Hz, " + std::to_string(wall.stiffness) +
         " N/mm: " + std::to_string(felt.energy) + " mJ";
}

// A coarse part of docs/swing.csv.
TEST(slow_loop, gives_no_hand_more_than_100_mJ_without_a_word_and_is_warned_of_wherever_it_gives_energy) {
  double most = 0, most_kept_passive = 0;
  std::size_t ended = 0, active = 0, quiet = 0;
  for (const auto& make : {premium_1_5, omni})
    for (const Passivity passivity : {Passivity::damping, Passivity::tank, Passivity::observer})
      for (const bool presses : {false, true})
        for (const double rate : {100.0, 150.0, 300.0, 1000.0})
          for (const float stiffness : {0.25F, 1.0F, 2.0F, 5.0F}) {
            const HandOnWall wall{make(), rate, stiffness, passivity, presses, 4};
            const FeltOnWall felt = felt_on(wall);
            const ServoResult& run = felt.run;
            most = std::max(most, felt.energy);
            ended += run.trip && run.trip->rule == Rule::energy;
            if (run.passivity != Passivity::observer) most_kept_passive = std::max(most_kept_passive, run.account.owed());
            EXPECT_TRUE(felt.energy <= 100 || run.trip) << words_of(wall, felt);
            const bool warned = !words_if_active(static_cast<double>(stiffness), capabilities_of(wall.model), rate).empty();
            EXPECT_TRUE(felt.energy <= 5 || warned) << words_of(wall, felt);
            EXPECT_TRUE(felt.swing < 0.2 || warned) << words_of(wall, felt);
            active += felt.energy > 5;
            quiet += !warned;
          }
  std::printf("  at most %.1f mJ, %.1f of those kept passive; %zu runs ended for it\n", most, most_kept_passive, ended);
  EXPECT_LE(most_kept_passive, 50) << "the controller's own bound";
  EXPECT_GT(ended, 5U);
  EXPECT_GT(active, 20U);
  EXPECT_GT(quiet, 20U);
}

// The supervisor finds it and shortens it before it has its end in the energy account.
TEST(slow_loop, has_its_swing_named_oscillation) {
  for (const float stiffness : {1.0F, 2.0F}) {
    const FeltOnWall felt = felt_on({.rate = 100, .stiffness = stiffness});
    EXPECT_GT(felt.run.limited_ticks[static_cast<std::size_t>(Rule::oscillation)], 20U) << stiffness;
    EXPECT_LT(felt.swing, 3) << stiffness;
  }
}

TEST(slow_loop, leaves_a_soft_wall_as_it_is_at_every_rate) {
  for (const double rate : {100.0, 150.0, 300.0, 1000.0})
    for (const bool presses : {false, true}) {
      const FeltOnWall felt = felt_on({.rate = rate, .stiffness = 0.2F, .presses = presses});
      EXPECT_EQ(felt.run.account.altered, 0U) << rate;
      for (std::size_t rule = 0; rule < kRules; ++rule)
        EXPECT_TRUE(felt.run.limited_ticks[rule] == 0 || static_cast<Rule>(rule) == Rule::gentle_start)
            << rate << ' ' << name_of(static_cast<Rule>(rule));
    }
}

TEST(passive_rate, names_stiffness_rate_and_damping_where_they_cannot_be_passive) {
  EXPECT_EQ(
      words_if_active(2, capabilities_of(premium_1_5()), 100),
      "a stiffness of 2 N/mm at 100 Hz cannot be passive, so a hand may be made to swing: b >= KT/2 takes a damping of 10 "
      "N s/m; premium-1.5 has 0.0108, and a hand's flesh has some 1.3. That suffices for 0.262 N/mm at this rate, or for "
      "this stiffness from 763 Hz on");
  const std::string unknown = words_if_active(1234.5, {.model = "its", .peak_force = 8}, 10'000);
  EXPECT_NE(unknown.find("1234.5 N/mm at 10000 Hz"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("the device's own is not known, and a hand's flesh has some 1.3"), std::string::npos) << unknown;
}

TEST(passive_rate, counts_what_damping_gives_and_names_what_a_count_of_the_device_does) {
  const Capabilities device{.model = "its", .peak_force = 8};
  const damping::Parameters oil{.rate = 1000, .share = 0.5F, .damping = 0.003F}, tar{.rate = 1000, .damping = 0.002F};
  EXPECT_EQ(words_if_active(0.59, device, 1000, oil), "");
  EXPECT_EQ(
      words_if_active(0.7, device, 1000, oil),
      "a stiffness of 0.7 N/mm at 1000 Hz with a damping of 0.003 N s/mm cannot be passive, so a hand may be made to swing: "
      "b >= KT/2 + 1 N s/m takes a damping of 1.35 N s/m; the device's own is not known, and a hand's flesh has some 1.3. "
      "That suffices for 0.6 N/mm at this rate, or for this stiffness from 1167 Hz on");
  EXPECT_NE(words_if_active(0.1, device, 1000, tar).find("suffices for no stiffness with this damping"), std::string::npos);
  EXPECT_EQ(
      words_if_active(0.1, {.resolution = 0.03F, .peak_force = 8}, 1000, {.rate = 1000, .drag = 0.001F}),
      "one count of the device, 0.03 mm, changes the damped force by 0.03 N, which may be felt as chatter; with a smaller "
      "share of the filter, or less damping, it is less");
}

// 2 b/T is 2.6 N/mm at 1 kHz by the hand's flesh alone.
TEST(passive_rate, is_silent_where_they_may_be_and_where_nobody_is_pushed) {
  EXPECT_EQ(words_if_active(2.6, {.peak_force = 8}, 1000), "");
  EXPECT_NE(words_if_active(2.601, {.peak_force = 8}, 1000), "");
  EXPECT_EQ(words_if_active(2.61, {.peak_force = 8, .damping = 0.01F}, 1000), "");
  EXPECT_EQ(words_if_active(100, Null().capabilities(), 100), "");
}

}  // namespace
}  // namespace forceshade::device
