// SPDX-License-Identifier: BSD-3-Clause
// The passivity controller gives no more than it may, whatever the hand does, and accounts for it.

#include "device/passivity_controller.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "properties/field_properties.h"
#include "tests/device/unmoved_hand.h"

namespace forceshade::device {
namespace {

TEST(passivity_controller, stroke_across_force_shading_harvests_what_the_law_predicts) {
  for (const Parameters& p : {kBump, Parameters{10, 12, 1}, Parameters{100, 20, 0.2F}})
    for (const double depth : {0.5, 1.0, 2.0}) {
      const auto [R, w, K] = p;
      const double predicted = static_cast<double>(K * w * w / (8 * R)) * depth;
      Hand hand(law_of(LawId::bump_1p_shaded, p), Kind::observer);
      for (int n = 0; n < 5; ++n) hand.go_round(stroke(p, depth), 0.002);
      const double harvested = -hand.controller.account().balance / 5;
      EXPECT_NEAR(harvested, predicted, 0.02 * predicted);
      EXPECT_EQ(hand.controller.account().altered, 0U);
    }
}

// Each law's most profitable loop, with and without the controller.
TEST(passivity_controller, gives_nobody_who_goes_round_more_than_epsilon) {
  constexpr int kRounds = 15;
  for (const LawName& name : kLaws) {
    const auto subject = std::get<properties::RenderedLaw>(properties::fast_rendering(name.id, kBump));
    const auto loop = properties::witness_loop(subject.law, 2);
    double harvested = 0;
    for (const Kind kind : {Kind::observer, Kind::tank, Kind::damping}) {
      Hand hand(law_of(name.id), kind);
      hand.go_to({loop.vertices.front().x, 0, loop.vertices.front().z});
      const double begin = hand.controller.account().balance;
      for (int n = 0; n < kRounds; ++n) hand.go_round(loop.vertices, 0.002);
      const double given = begin - hand.controller.account().balance;
      if (kind == Kind::observer) {
        harvested = given;
        // A held force adds K D times the step, 0.002 mJ here, which is all that a conservative law gives.
        EXPECT_NEAR(given / kRounds, loop.given_mJ, loop.given_mJ > 0 ? 0.02 * loop.given_mJ : 0.005) << name.name;
        continue;
      }
      EXPECT_GE(static_cast<double>(hand.lowest), -hand.settings.epsilon);
      EXPECT_TRUE(harvested <= hand.settings.epsilon || given < harvested);
    }
  }
}

// Rests for a tick, so that nothing warns of it, then goes as far as it can along the force. The bound is reached.
TEST(passivity_controller, bound_is_reached_by_the_worst_hand_and_not_passed) {
  for (const Kind kind : {Kind::tank, Kind::damping})
    for (const bool latency : {false, true}) {
      Hand hand(law_of(LawId::wall, {.stiffness = 2}), kind, passivity_settings({.latency = latency}, 1000));
      hand.go_to({0, 0, -20});
      hand.go_to({0, 0, -20});
      hand.go_to({0, 0, -20});
      for (int n = 0; n < 3; ++n) hand.go_to(hand.at + Position(0, 0, hand.settings.longest_step));
      EXPECT_GE(hand.lowest, -hand.settings.epsilon);
      EXPECT_LE(hand.lowest, -(latency ? 0.74 : 0.999) * hand.settings.epsilon);
    }
}

// One leg of an adversary's motion.
struct Leg {
  int x, z;   // the goal, in 0.05 mm
  int speed;  // in thousandths of the longest step
  int way;    // 0, 1: straight there; 2: along the force; 3: to and fro along the force; 4: anywhere
  int ticks;  // of the last three
};

Leg any_leg(std::mt19937& random) {
  const auto from = [&](int low, int high) { return drawn_from(random, low, high); };
  return {from(-350, 350), from(-100, 199), from(0, 1) == 0 ? 1000 : from(5, 1000), from(0, 4), from(1, 59)};
}

void walk(Hand& hand, const Leg& leg, int turns[5]) {
  ++turns[leg.way];
  // Short of the longest step by more than binary32 positions can add to it.
  const double step = 0.9999 * hand.settings.longest_step * leg.speed / 1000;
  if (leg.way < 2) return hand.go_to({0.05 * leg.x, 0, 0.05 * leg.z}, step);
  for (int tick = 0; tick < leg.ticks; ++tick) {
    const Position along = hand.force.cast<double>().stableNormalized();
    const double turned = 0.1 * leg.x * tick;
    const Position way = leg.way == 2   ? along
                         : leg.way == 3 ? Position(tick % 2 == 0 ? along : Position(-along))
                                        : Position(std::cos(turned), 0, std::sin(turned));
    hand.go_to(hand.at + step * way);
  }
}

// Closed polygons and motions that follow the force, at any speed up to the longest step, twenty times over.
TEST(passivity_controller, gives_no_more_than_epsilon_whatever_the_hand_does) {
  for (const LawName& name : kLaws)
    for (const Kind kind : {Kind::observer, Kind::tank, Kind::damping})
      for (const bool latency : {false, true}) {
        const PassivitySettings settings = passivity_settings({.latency = latency}, 1000);
        int turns[5] = {};
        double lowest = 0;
        expect_for_all(std::string(name.name) + ", " + words_of(kind), 20260, 60, [&](std::mt19937& random) {
          std::vector<Leg> legs(static_cast<std::size_t>(drawn_from(random, 1, 40)));
          for (Leg& leg : legs) leg = any_leg(random);
          Hand hand(law_of(name.id), kind, settings);
          hand.go_to({0.05 * legs.front().x, 0, 0.05 * legs.front().z});
          for (int round = 0; round < 20; ++round)
            for (const Leg& leg : legs) walk(hand, leg, turns);
          const PassivityAccount& account = hand.controller.account();
          lowest = std::min(lowest, static_cast<double>(hand.lowest));
          EXPECT_LE(std::fabs(static_cast<double>(hand.balance) - account.balance), kRounding);
          EXPECT_LE(account.longest_step, settings.longest_step);
          EXPECT_FALSE(hand.lengthened);
          EXPECT_TRUE(kind == Kind::observer || hand.lowest >= -settings.epsilon - kRounding);
        });
        for (const int reached : turns) EXPECT_GT(reached, 0);
        // The same hands do harvest without it.
        EXPECT_TRUE(kind != Kind::observer || lowest < -3 * settings.epsilon);
      }
}

TEST(passivity_controller, damping_turns_a_force_and_the_tank_does_not) {
  for (const Kind kind : {Kind::tank, Kind::damping}) {
    Hand hand(law_of(LawId::bump_2p_shaded), kind);
    double turned = 0;
    for (int n = 0; n < 30; ++n)
      for (const Position& corner : {Position(5, 0, 0), Position(14, 0, -2), Position(14, 0, 5), Position(-3, 0, 6)}) {
        const Position from = hand.at;
        for (int i = 1; i <= 40; ++i) {
          hand.go_to(from + (corner - from) * (i / 40.0));
          turned = std::max(turned, static_cast<double>(hand.force.cross(hand.desired).norm()));
        }
      }
    EXPECT_GT(hand.controller.account().altered, 50U);
    EXPECT_EQ(turned > 1e-6, kind == Kind::damping);
  }
}

TEST(passivity_controller, friction_pays_debts_and_saves_nothing) {
  PassivitySettings settings = passivity_settings({}, 1000);
  settings.friction = 0.04;
  Hand hand(law_of(LawId::bump_1p_shaded), Kind::tank, settings);
  hand.go_to({0, 0, 10});
  hand.go_to({0, 0, 5}, 0.1);
  EXPECT_EQ(hand.controller.account().balance, 0);
  hand.go_round(stroke(kBump, 2), 0.02);
  EXPECT_GT(hand.controller.account().dissipated, 0.1);
  EXPECT_NEAR(static_cast<double>(hand.balance) + hand.controller.account().dissipated, hand.controller.account().balance,
              1e-9);
  EXPECT_NEAR(hand.controller.account().net(), -static_cast<double>(hand.balance), 1e-9) << "given to the hand, less taken";
  hand.go_to({0, 0, 50}, 0.1);
  EXPECT_EQ(hand.controller.account().balance, 0);
}

TEST(passivity_controller, gives_no_force_at_what_is_no_position_and_assumes_the_worst_of_it) {
  const float nan = std::nanf("");
  PassivityController controller({.longest_step = 1, .epsilon = 10});
  EXPECT_EQ(controller.limited({.position = {0, 0, -1}}, {0, 0, 2}), Eigen::Vector3f(0, 0, 2));
  EXPECT_EQ(controller.limited({.position = {0, nan, -1}}, {0, 0, 2}), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(controller.account().balance, -2);
  EXPECT_EQ(controller.limited({.position = {0, 0, 5}}, {0, 0, 1}), Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(controller.account().balance, -2);
  EXPECT_EQ(controller.limited({.position = {0, 0, 5.5F}}, {0, 0, HUGE_VALF}), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(controller.account().balance, -2.5) << "the step was seen";
  EXPECT_EQ(controller.account().longest_step, 0.5) << "and the one to 5 mm was not";
  PassivityController rough({.longest_step = 1, .epsilon = 10, .friction = 0.5});
  rough.limited({.position = {0, 0, -1}}, {0, 0, 2});
  rough.limited({.position = {0, nan, -1}}, {0, 0, 2});
  EXPECT_EQ(rough.account().dissipated, 0) << "no friction is counted in it";
  EXPECT_EQ(rough.account().balance, -2);
}

// A step of 5 mm where 1 mm is the longest: as after a stall of a device that clamps nothing by itself. 1 N x 5 mm are given,
// of which 2 mJ were allowed; what is forgiven leaves half of that.
TEST(passivity_controller, forgives_what_a_stall_took_and_says_how_much) {
  for (const Kind kind : {Kind::tank, Kind::damping}) {
    PassivityController controller({.longest_step = 1, .epsilon = 2}, kind);
    controller.limited({.position = {0, 0, 0}}, {0, 0, 1});
    EXPECT_GT(controller.limited({.position = {0, 0, 5}}, {0, 0, 1}).norm(), 0) << "it is not lost for ever";
    EXPECT_EQ(controller.account().lowest_balance, -5);
    EXPECT_EQ(controller.account().forgiven, 4);
    EXPECT_EQ(controller.account().balance, -1);
    EXPECT_EQ(controller.account().net(), 5) << "it was given all the same";
    EXPECT_EQ(controller.allowance().work, 2 + 4);
    const Eigen::Vector3f acting = controller.limited({.position = {0, 0, 5}}, {0, 0, 1});
    controller.limited({.position = {0, 0, 4.5F}}, {0, 0, 1});
    EXPECT_EQ(controller.account().balance, -1 + 0.5 * static_cast<double>(acting.z())) << "and the account goes on";
  }
}

// By hand: desired 3 N, of which epsilon allows 1/1.25 on a step of 1 mm; half a millimetre along it, a quarter back, with as
// much as was desired.
TEST(passivity_controller, accounts_for_what_it_altered) {
  PassivityController controller({.longest_step = 1, .epsilon = 1}, Kind::tank);
  controller.limited({.position = {0, 0, 0}}, {0, 0, 3});
  controller.limited({.position = {0, 0, 0.5F}}, {0, 0, 0.1F});
  controller.limited({.position = {0, 0, 0.25F}}, {0, 0, 0.1F});
  const PassivityAccount& account = controller.account();
  EXPECT_EQ(account.altered, 1U);
  EXPECT_NEAR(account.largest_change, 3 - 0.8, 1e-5);
  EXPECT_NEAR(account.withheld, (3 - 0.8) * 0.5, 1e-5);
  EXPECT_NEAR(account.given, 0.8 * 0.5, 1e-5);
  EXPECT_NEAR(account.balance, -0.8 * 0.5 + 0.1 * 0.25, 1e-5);
  EXPECT_NEAR(account.lowest_balance, -0.8 * 0.5, 1e-5);
  EXPECT_EQ(account.longest_step, 0.5);
}

// The force desired at a reading acts from the next one on.
TEST(passivity_controller, knows_which_force_was_withheld_where_it_is_felt_late) {
  PassivityController controller({.longest_step = 1, .epsilon = 1, .latency = true});
  const auto pass = [&](float z, float desired, float acted, double work) {
    controller.limited({.position = {0, 0, z}, .sent = Sent{.acted = {0, 0, acted}, .work = work}}, {0, 0, desired});
  };
  pass(0, 3, 0, 0);
  pass(0.25F, 0, 0, 0);
  EXPECT_EQ(controller.account().withheld, 0);
  pass(0.5F, 0, 0.5F, 0.125);
  EXPECT_EQ(controller.account().withheld, 3 * 0.25 - 0.125);
  EXPECT_EQ(controller.account().given, 0.125);
  pass(0.75F, 0, 0, 0.125);
  EXPECT_EQ(controller.account().withheld, 3 * 0.25 - 0.125);
}

TEST(passivity_controller, is_set_for_a_hand_at_a_metre_a_second_and_half_of_the_devices_friction) {
  for (const bool latency : {false, true}) {
    const PassivitySettings settings = passivity_settings({.resolution = 0.03F, .latency = latency, .friction = 0.04F}, 500);
    EXPECT_NEAR(settings.longest_step, 2.06, 1e-6);
    EXPECT_NEAR(settings.epsilon, (latency ? 4 : 1) * 2.06 * 2.06, 1e-5);
    EXPECT_NEAR(settings.friction, 0.02, 1e-9);
    EXPECT_EQ(settings.latency, latency);
  }
}

// s is 10.06 mm at 100 Hz, whose square is 101 mJ.
TEST(passivity_controller, lends_no_slow_loop_more_than_half_of_what_the_supervisor_allows) {
  for (const bool latency : {false, true})
    EXPECT_EQ(passivity_settings({.resolution = 0.03F, .latency = latency}, 100).epsilon, 50) << latency;
  EXPECT_LT(passivity_settings({.resolution = 0.03F, .latency = true}, 290).epsilon, 50);
}

TEST(passivity_controller, counts_what_a_hand_owes_with_what_was_forgiven_and_never_below_nothing) {
  EXPECT_EQ((PassivityAccount{.balance = -2, .forgiven = 3}.owed()), 5);
  EXPECT_EQ((PassivityAccount{.balance = 2, .forgiven = 3}.owed()), 3) << "what is put in later is not set against it";
}

// Ten minutes at 1 kHz, against sums of twice the precision.
TEST(passivity_controller, account_does_not_drift) {
  Hand hand(law_of(LawId::bump_3p_shaded), Kind::observer);
  for (int tick = 0; tick < 600'000; ++tick)
    hand.go_to({14 * std::sin(0.0037 * tick), std::sin(0.0011 * tick), 2 * std::sin(0.0071 * tick)});
  const double drift = std::fabs(static_cast<double>(hand.balance) - hand.controller.account().balance);
  EXPECT_LE(drift, kRounding);
}

}  // namespace
}  // namespace forceshade::device
