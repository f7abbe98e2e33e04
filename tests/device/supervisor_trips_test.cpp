// SPDX-License-Identifier: BSD-3-Clause
// The rules that end a run, and the user who alone begins another.

#include <tuple>

#include "tests/device/supervised_hand.h"

namespace forceshade::device {
namespace {

TEST(supervisor, holds_the_force_of_late_ticks_then_ramps_it_down_then_trips) {
  Hand hand(lenient());
  hand.supervise({0, 0, 1});
  hand.late = 0.001;
  EXPECT_EQ(hand.supervise({0, 0, 1.5F}).force.z(), 1.5F) << "late by no more than a period";
  hand.supervise({0, 0, 1});
  hand.late = 0.0011;
  for (int tick = 0; tick < 3; ++tick) {
    const Verdict verdict = hand.supervise({0, 0, 2});
    expect_only(verdict, Rule::missed_deadlines);
    EXPECT_EQ(verdict.force.z(), 1);
  }
  for (int tick = 1; tick < 20; ++tick) ASSERT_NEAR(hand.supervise({0, 0, 2}).force.z(), 1 - tick / 20.0, 1e-5);
  expect_tripped(hand.supervise({0, 0, 2}), Rule::missed_deadlines);
}

TEST(supervisor, comes_back_from_a_few_late_ticks_and_never_holds_more_than_is_wanted) {
  Hand hand(lenient());
  hand.supervise({0, 0, 1});
  hand.late = 0.0015;
  EXPECT_NEAR(hand.supervise({0, 0, 0.25F}).force.z(), 0.25, 1e-6);
  EXPECT_EQ(hand.supervise({0, 0, 0}).force.z(), 0);
  EXPECT_EQ(hand.supervise({0, 0, 2}).force.z(), 1) << "held is the force of the last tick in time";
  hand.supervise_for(10, {0, 0, 1});
  hand.late = 0;
  EXPECT_EQ(hand.supervise({0, 0, 2}).force.z(), 2);
  hand.late = 0.0015;
  EXPECT_EQ(hand.supervise_for(3, {0, 0, 3}).force.z(), 2);
}

TEST(supervisor, gives_back_as_slowly_as_after_a_gentle_start_what_late_ticks_took_away) {
  SupervisorLimits limits = lenient();
  limits.ramp_up = 0.5;
  Hand hand(limits);
  hand.supervise_for(500, {0, 0, 2});
  hand.late = 0.0011;
  EXPECT_NEAR(hand.supervise_for(3 + 10, {0, 0, 2}).force.z(), 1, 1e-5);
  hand.late = 0;
  for (int tick = 1; tick <= 250; ++tick) ASSERT_NEAR(hand.supervise({0, 0, 2}).force.z(), 1 + tick / 250.0, 1e-5) << tick;
}

TEST(supervisor, gives_late_ticks_no_force_after_the_ramp_and_trips_no_earlier_than_the_watchdog_timeout) {
  SupervisorLimits limits = lenient();
  limits.watchdog_timeout = 0.05;
  Hand hand(limits);
  hand.supervise({0, 0, 1});
  hand.late = 0.0011;
  for (int tick = 1; tick < 50; ++tick) {
    const Verdict verdict = hand.supervise({0, 0, 2});
    ASSERT_FALSE(verdict.trip) << tick;
    ASSERT_EQ(verdict.force.z() == 0, tick >= 3 + 20) << tick;
  }
  expect_tripped(hand.supervise({0, 0, 2}), Rule::missed_deadlines);
}

TEST(supervisor, treats_the_force_of_an_unfinished_tick_as_that_of_a_late_one) {
  Hand hand(lenient());
  hand.supervise({0, 0, 1});
  hand.unfinished = true;
  expect_only(hand.supervise({0, 0, 20}), Rule::unfinished);
  EXPECT_EQ(hand.supervise({3, 0, 4}).force, Force(0, 0, 1)) << "the force of the last finished tick";
  EXPECT_NEAR(hand.supervise({0, 0, 0.5F}).force.z(), 0.5, 1e-6) << "never more than is wanted";
  hand.unfinished = false;
  EXPECT_EQ(hand.supervise({0, 0, 2}).force.z(), 2) << "one finished tick ends it";
  hand.unfinished = true;
  for (int tick = 0; tick < 3; ++tick) ASSERT_EQ(hand.supervise({0, 0, 20}).force.z(), 2);
  for (int tick = 1; tick < 20; ++tick) ASSERT_NEAR(hand.supervise({0, 0, 20}).force.z(), 2 - tick / 10.0, 1e-5);
  EXPECT_EQ(hand.supervisor.count(Rule::unfinished), 25U);
  EXPECT_EQ(hand.supervisor.count(Rule::missed_deadlines), 0U);
  expect_tripped(hand.supervise({0, 0, 20}), Rule::unfinished);
}

TEST(supervisor, counts_late_and_unfinished_ticks_in_one_row_and_names_the_last_one) {
  for (const bool last_is_late : {false, true}) {
    Hand hand(lenient());
    hand.supervise({0, 0, 1});
    for (int tick = 0; tick < 23; ++tick) {
      hand.late = (tick % 2 == 0) == last_is_late ? 0.0011 : 0;
      hand.unfinished = hand.late == 0;
      const Verdict verdict = hand.supervise({0, 0, 2});
      if (tick < 22) {
        expect_only(verdict, hand.unfinished ? Rule::unfinished : Rule::missed_deadlines);
      } else {
        expect_tripped(verdict, last_is_late ? Rule::missed_deadlines : Rule::unfinished);
      }
    }
  }
}

// Recordings hold the rules that limited as bits.
TEST(supervisor, gives_each_rule_that_limits_a_bit_of_its_own_and_other_rules_none) {
  unsigned taken = 0;
  for (std::size_t i = 0; i < kRules; ++i) {
    const Rule rule = static_cast<Rule>(i);
    Rules rules;
    rules.add(rule);
    EXPECT_EQ(rules.has(rule), Rules::limits(rule)) << name_of(rule);
    if (!Rules::limits(rule)) continue;
    EXPECT_EQ(rules.bits(), 1U << Rules::bit_of(rule));
    EXPECT_EQ(taken & rules.bits(), 0U) << name_of(rule);
    taken |= rules.bits();
  }
  EXPECT_EQ(taken, 0b1100'0000'1111'1111U);
}

TEST(supervisor, trips_at_once_after_a_long_stall) {
  for (const auto& [late, trips] : {std::pair{0.02, false}, std::pair{0.0201, true}, std::pair{std::nan(""), true}}) {
    Hand hand(lenient());
    hand.supervise({0, 0, 1});
    hand.late = late;
    const Verdict verdict = hand.supervise({0, 0, 1});
    EXPECT_EQ(verdict.trip.has_value(), trips) << late;
    if (trips) expect_tripped(verdict, Rule::watchdog);
  }
}

TEST(supervisor, trips_at_a_force_that_is_none) {
  for (const float value : {kNan, HUGE_VALF}) {
    Hand hand(lenient());
    expect_tripped(hand.supervise({value, 0, 1}), Rule::invalid_force);
  }
}

// By the loop's clock or by the device's, whichever is longer; to every rule about speed, with and without an encoder.
TEST(supervisor, holds_a_step_against_the_time_since_the_last_reading) {
  struct Case {
    double late_before, late, by_device, expected;  // s
  };
  for (const auto& [late_before, late, by_device, expected] :
       {Case{0, 0, 0.001, 0.001}, Case{0, 0.0009, 0.001, 0.0019}, Case{0.0004, 0.0009, 0.001, 0.0015},
        Case{0.0009, 0.0009, 0.001, 0.001}, Case{0.0009, 0.0002, 0.001, 0.001}, Case{0.0009, 0.0002, 0.0005, 0.001},
        Case{0, 0, 0.003, 0.003}, Case{0, 0.0009, 0.0015, 0.0019}, Case{0, 0, 0.020, 0.020}, Case{0, 0, 1, 0.021}})
    for (const auto& [speed, force, rule] : {std::tuple{5000.0, 0.0F, Rule::jump}, std::tuple{1000.0, 0.01F, Rule::velocity}})
      for (const double resolution : {0.0, 0.025})
        for (const double share : {0.9999, 1.0001}) {
          SupervisorLimits limits = lenient();
          limits.resolution = resolution;
          Hand hand(limits);
          hand.reading.position.setZero();
          const auto next = [&](double seconds) {
            hand.reading.time += seconds;
            return hand.supervise({0, 0, force});
          };
          for (int tick = 0; tick < 30; ++tick) next(0.001);
          hand.late = late_before;
          next(0.001);
          hand.tremor = 0;
          hand.late = late;
          hand.reading.position.x() += static_cast<float>(share * (speed * expected + 2 * resolution));
          const Verdict verdict = next(by_device);
          if (share < 1)
            EXPECT_FALSE(verdict.trip) << name_of(rule) << late_before << ' ' << late << ' ' << by_device;
          else
            expect_tripped(verdict, rule);
        }
}

TEST(supervisor, trips_when_a_hand_owes_more_energy_than_brings_it_to_a_metre_a_second) {
  Hand hand(lenient());
  hand.supervise({0, 0, 1});
  hand.supervisor.commanded({0, 0, 1}, 100);
  EXPECT_FALSE(hand.supervise({0, 0, 1}).trip);
  hand.supervisor.commanded({0, 0, 1}, 100.1);
  expect_tripped(hand.supervise({0, 0, 1}), Rule::energy);
}

SupervisorLimits with_resolution(double resolution) {
  SupervisorLimits limits = lenient();
  limits.resolution = resolution;
  return limits;
}

// A hand that steps on by `step` mm for as many ticks, or rests, and whether its encoder is taken for a frozen one.
class Stepping {
 public:
  explicit Stepping(double resolution = 0.03) : hand_(with_resolution(resolution)) { hand_.tremor = 0; }
  void step(int ticks, double step, double late = 0, float force = 1) {
    hand_.late = late;
    for (int tick = 0; tick < ticks; ++tick) {
      hand_.reading.position.x() += static_cast<float>(step);
      trips_ = hand_.supervise({0, 0, force}).trip == Rule::frozen_encoder;
    }
  }
  void rest(int ticks, float force = 1) { step(ticks, 0, 0, force); }
  bool trips() const { return trips_; }

 private:
  Hand hand_;
  bool trips_ = false;
};

// The hand steps on by `step` mm, then every reading is the same.
int ticks_until_frozen(double step, double resolution, float force, float change_per_tick = 0) {
  Stepping hand(resolution);
  hand.step(10, step, 0, force);
  for (int tick = 1; tick <= 1000; ++tick) {
    hand.rest(1, force + change_per_tick * static_cast<float>(tick));
    if (hand.trips()) return tick;
  }
  return 0;
}

TEST(supervisor, trips_at_an_encoder_that_stops_dead_under_force) {
  EXPECT_EQ(ticks_until_frozen(0.161, 0.03, 1), 20);
  EXPECT_EQ(ticks_until_frozen(0.159, 0.03, 1), 0) << "a hand can stop from there";
  EXPECT_EQ(ticks_until_frozen(0.161, 0.03, 0), 0) << "no force";
  EXPECT_EQ(ticks_until_frozen(0.161, 0, 1), 0) << "no encoder";
}

TEST(supervisor, counts_the_ticks_of_a_frozen_encoder_anew_when_it_moves) {
  Stepping hand;
  hand.step(5, 0.161);
  for (int again = 0; again < 3; ++again) {
    hand.rest(19);
    EXPECT_FALSE(hand.trips()) << again;
    hand.step(1, 0.161);
  }
  hand.rest(20);
  EXPECT_TRUE(hand.trips());
}

TEST(supervisor, takes_a_long_step_of_a_late_tick_for_no_fast_one) {
  for (const auto& [step, trips] : {std::pair{0.161, false}, std::pair{0.259, false}, std::pair{0.261, true}}) {
    Stepping hand;
    hand.step(5, 0.01);
    hand.step(1, step, 0.001);
    hand.rest(20);
    EXPECT_EQ(hand.trips(), trips) << step;
  }
}

TEST(supervisor, forgives_a_resting_encoder_a_force_that_changed_and_came_back) {
  Stepping hand;
  hand.step(1, 0.01);
  hand.rest(5);
  for (int again = 0; again < 3; ++again) {
    hand.rest(19, 1.6F);
    hand.rest(1);
  }
  EXPECT_FALSE(hand.trips());
  hand.rest(21, 1.6F);  // felt from the second of these on
  EXPECT_TRUE(hand.trips());
}

TEST(supervisor, trips_at_an_encoder_that_a_changing_force_does_not_move) {
  // The force that is felt at tick n is that of tick n - 1: half a newton more at the 501st of these.
  EXPECT_NEAR(ticks_until_frozen(0.01, 0.03, 1, 0.001F), 521, 1);
  EXPECT_EQ(ticks_until_frozen(0.01, 0.03, 1, 0.1F), 26) << "a hand needs time to move";
  EXPECT_EQ(ticks_until_frozen(0.01, 0.03, 1, 0.00049F), 0);
}

TEST(supervisor, stays_tripped_until_the_user_says_otherwise_and_then_starts_gently) {
  SupervisorLimits limits = lenient();
  limits.felt_free = 0.01;
  Hand hand(limits);
  for (int tick = 0; tick < 10; ++tick) hand.supervise({0, 0, 0}, Status::free);
  hand.supervise({0, 0, 1});
  const Eigen::Vector3f before = hand.reading.position;
  hand.reading.position.x() = kNan;
  expect_tripped(hand.supervise({0, 0, 1}), Rule::invalid_position);
  hand.reading.position = before;
  for (int tick = 0; tick < 1000; ++tick) expect_tripped(hand.supervise({0, 0, 1}), Rule::invalid_position);
  EXPECT_EQ(hand.supervisor.tripped()->rule, Rule::invalid_position);
  EXPECT_EQ(hand.supervisor.tripped()->tick, 13U);
  EXPECT_EQ(hand.supervisor.count(Rule::invalid_position), 1U);
}

}  // namespace
}  // namespace forceshade::device
