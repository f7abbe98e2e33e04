// SPDX-License-Identifier: BSD-3-Clause
// The passivity controller in use: walls that are pressed, trembling, strokes; what it withholds there, and how little; and
// that a hand which moves smoothly on an account that is almost empty feels no buzz.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "device/passivity_controller.h"
#include "device/simulated/simulated.h"
#include "tests/device/unmoved_hand.h"

namespace forceshade::device {
namespace {

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

// One swing along an axis, in mm, Hz and turns.
struct Swing {
  int size, frequency, phase;  // in hundredths
};

// At most 12 mm, and 300 mm/s.
Swing any_swing(std::mt19937& random) {
  const int frequency = drawn_from(random, 10, 399), fast = static_cast<int>(300 * 100 / (2 * M_PI * frequency / 100));
  return {drawn_from(random, 1, std::min(1199, fast)), frequency, drawn_from(random, 0, 99)};
}

double at(const Swing& swing, double time) {
  return 0.01 * swing.size * std::sin(2 * M_PI * (0.01 * swing.frequency * time + 0.01 * swing.phase));
}

// In counts of 0.03 mm, as encoders have it.
Position counted(const Position& position) {
  return 0.03 * (position / 0.03).array().round().matrix();
}

// Strokes that empty the account, a second's way to where the hand begins, and three seconds of it.
TEST(passivity_controller, lets_no_smooth_hand_feel_a_buzz) {
  for (const LawId id : {LawId::wall, LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded})
    for (const Kind kind : {Kind::tank, Kind::damping})
      for (const bool latency : {false, true}) {
        const PassivitySettings settings = passivity_settings({.resolution = 0.03F, .latency = latency}, 1000);
        std::size_t altered = 0;
        expect_for_all(words_of(id) + ", " + words_of(kind) + (latency ? ", latency" : ""), 20261, 200,
                       [&](std::mt19937& random) {
                         std::array<Swing, 6> swings;
                         for (Swing& swing : swings) swing = any_swing(random);
                         const int deep = drawn_from(random, -200, 799);  // hundredths of a mm, in the middle
                         const auto hand_at = [&](double time) {
                           return Position(at(swings[0], time) + at(swings[1], time), at(swings[2], time) + at(swings[3], time),
                                           0.3 * (at(swings[4], time) + at(swings[5], time)) - 0.01 * deep);
                         };
                         Hand hand(law_of(id), kind, settings);
                         for (int round = 0; round < 12; ++round) hand.go_round(stroke(kBump, 4), 0.2);
                         const Position from = hand.at;
                         for (int tick = 0; tick <= 1000; ++tick)
                           hand.go_to(counted(from + (hand_at(0) - from) * (tick / 1000.0)));
                         hand.chatter = {};
                         for (int tick = 1; tick < 3000; ++tick) hand.go_to(counted(hand_at(tick / 1000.0)));
                         altered += hand.controller.account().altered;
                         EXPECT_EQ(hand.chatter.ticks, 0U);
                         EXPECT_GE(hand.lowest, -settings.epsilon - kRounding);
                       });
        EXPECT_TRUE(altered > 0 || id == LawId::wall) << words_of(id);
      }
}

}  // namespace
}  // namespace forceshade::device
