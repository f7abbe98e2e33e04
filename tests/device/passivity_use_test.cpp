// SPDX-License-Identifier: BSD-3-Clause
// The passivity controller in use: walls that are pressed, trembling, strokes; what it withholds there, and how little.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "device/passivity_controller.h"
#include "device/simulated/simulated.h"
#include "tests/device/unmoved_hand.h"

namespace forceshade::device {
namespace {

// A press to the depth D and back at speed v gives K D v T more than it takes, since the force is held; with a sample of
// latency three times that, less 4 K (v T)² where the hand turns.
TEST(passivity_controller, sampled_wall_gives_a_little_and_how_much) {
  for (const bool latency : {false, true}) {
    Hand hand(law_of(LawId::wall), Kind::observer, passivity_settings({.latency = latency}, 1000));
    for (int n = 0; n < 10; ++n) {
      hand.go_to({0, 0, -2}, 0.1);
      hand.go_to({0, 0, 0}, 0.1);
    }
    hand.go_to({0, 0, 0.1});
    hand.go_to({0, 0, 0.2});
    const double predicted = 10 * 0.5 * (latency ? 3 * 2 * 0.1 - 4 * 0.1 * 0.1 : 2 * 0.1);
    const double given = -hand.controller.account().balance;
    std::printf("  %.4f mJ a press to 2 mm at 100 mm/s%s\n", given / 10, latency ? " with latency" : "");
    EXPECT_NEAR(given, predicted, 0.01 * predicted);
  }
}

// 0.1 mm rms at 8 to 12 Hz, over counts of 0.03 mm.
TEST(passivity_controller, trembling_on_encoder_counts_harvests_a_little_from_a_wall_and_friction_pays_it) {
  const Intention rest({{0, {3, 0, 5}}, {1, {3, 0, -3}}}, Intention::Between::minimum_jerk);
  for (const double friction : {0.0, 0.02}) {
    Simulated device(premium_1_5(), Operator{Grip{}, rest, Tremor(1, 0.1), false});
    device.start(1000);
    PassivitySettings settings = passivity_settings(device.capabilities(), 1000);
    settings.friction = friction;
    PassivityController controller(settings, Kind::observer);
    double begin = 0;
    for (int tick = 0; tick < 22'000; ++tick) {
      const Reading reading = std::get<Reading>(device.read());
      device.command(controller.limited(reading, law_of(LawId::wall).force(reading.position)));
      if (tick == 2000) begin = controller.account().balance;
    }
    const double harvested = (begin - controller.account().balance) / 20;
    std::printf("  friction %.2f N: %.4f mJ/s, lowest %.4f mJ\n", friction, harvested, controller.account().lowest_balance);
    EXPECT_LT(harvested, 0.03);
    EXPECT_EQ(controller.account().lowest_balance < -0.1, friction == 0);
    EXPECT_TRUE(friction == 0 || controller.account().lowest_balance > -0.02);
  }
}

// To 3 mm, twice, while that costs no more than a quarter of epsilon: a press costs K D v T, three times that with latency.
TEST(passivity_controller, leaves_a_wall_alone_that_is_pressed_at_the_speed_of_a_hand) {
  for (const Kind kind : {Kind::tank, Kind::damping})
    for (const bool latency : {false, true})
      for (const float K : {0.2F, 0.5F, 0.8F, 1.0F})
        for (const double step : {0.02, 0.05, 0.1, 0.2}) {
          Hand hand(law_of(LawId::wall, {.stiffness = K}), kind, passivity_settings({.latency = latency}, 1000));
          const double costs = 2 * static_cast<double>(K) * 3 * step * (latency ? 3 : 1);
          if (costs > hand.settings.epsilon / 4) continue;
          hand.go_to({0, 0, 1});
          for (int n = 0; n < 2; ++n) {
            hand.go_to({0, 0, -3}, step);
            hand.go_to({0, 0, 1}, step);
          }
          EXPECT_EQ(hand.controller.account().altered, 0U)
              << words_of(kind) << " K = " << K << ", " << 1000 * step << " mm/s" << (latency ? " latency" : "");
        }
}

// However long it was harvested, a wall that is pressed pushes back, in full from a few millimetres on.
TEST(passivity_controller, has_force_again_for_a_hand_that_pushes) {
  for (const Kind kind : {Kind::tank, Kind::damping}) {
    Hand hand(law_of(LawId::bump_1p_shaded), kind);
    hand.go_to({0, 0, 0});
    for (int n = 0; n < 300; ++n) hand.go_round(stroke(kBump, 2), 0.1);
    hand.go_to({40, 0, 1}, 0.5);
    double full = 0;
    for (int i = 0; i <= 500 && full == 0; ++i) {
      hand.go_to({40, 0, -0.01 * i});
      EXPECT_TRUE(i != 100 || hand.force.norm() > 0.4F * hand.desired.norm()) << words_of(kind);
      if (i > 100 && hand.force == hand.desired) full = 0.01 * i;
    }
    std::printf("  %s: in full from %.2f mm on\n", words_of(kind), full);
    EXPECT_GT(full, 0);
    EXPECT_LT(full, 4);
  }
}

// The table of device/passivity.md: a simulated Premium 1.5 whose hand strokes to and fro for 20 s; it feels a force
// one sample late.
TEST(passivity_controller, alters_ordinary_strokes_little) {
  struct Case {
    Kind kind;
    double friction;  // N
  };
  std::printf("  law            kind     friction  balance   lowest  altered  rms, N  most, N  of rms, N  chatter\n");
  for (const LawId id : {LawId::wall, LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded})
    for (const auto& [kind, friction] :
         {Case{Kind::observer, 0}, Case{Kind::tank, 0}, Case{Kind::damping, 0}, Case{Kind::damping, 0.02}}) {
      Simulated device(premium_1_5(), Operator{Grip{}, strokes(), Tremor(1, 0.03), false});
      device.start(1000);
      PassivitySettings settings = passivity_settings(device.capabilities(), 1000);
      settings.friction = friction;
      PassivityController controller(settings, kind);
      double changes = 0, forces = 0;  // N²
      int contacts = 0;
      tests::Chatter chatter;
      for (int tick = 0; tick < 20'000; ++tick) {
        const Reading reading = std::get<Reading>(device.read());
        const fast::Evaluation desired = law_of(id).evaluate(reading.position);
        const Eigen::Vector3f force = controller.limited(reading, desired.force);
        device.allow(controller.allowance());
        device.command(force);
        chatter.next(force, desired.force);
        if (desired.status != Status::contact) continue;
        ++contacts;
        changes += (force - desired.force).cast<double>().squaredNorm();
        forces += desired.force.cast<double>().squaredNorm();
      }
      const PassivityAccount& account = controller.account();
      const double altered = static_cast<double>(account.altered) / contacts;
      std::printf("  %-14s %-8s %8.2f %8.3f %8.3f %7.2f%% %7.4f %8.3f %10.3f %8zu\n", words_of(id).c_str(), words_of(kind),
                  friction, account.balance, account.lowest_balance, 100 * altered, std::sqrt(changes / contacts),
                  account.largest_change, std::sqrt(forces / contacts), chatter.ticks);
      if (kind == Kind::observer) continue;
      EXPECT_GE(account.lowest_balance, -settings.epsilon);
      EXPECT_EQ(chatter.ticks, 0U);
      EXPECT_LE(altered, kind == Kind::tank ? 0.12 : 0.03);
      EXPECT_LE(changes, (kind == Kind::tank ? 0.015 : 0.004) * forces);
      const bool gives_energy = id == LawId::bump_2p_shaded || id == LawId::bump_3p_shaded;
      EXPECT_TRUE(friction > 0 || account.altered > 0 || !gives_energy) << words_of(id);
      EXPECT_TRUE(gives_energy || account.altered == 0) << words_of(id);
    }
}

}  // namespace
}  // namespace forceshade::device
