// SPDX-License-Identifier: BSD-3-Clause
// The rules that end a run, and the user who alone begins another.

#include "forceshade/tests/supervised_hand.h"

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
  hand.supervise_for(10, {0, 0, 1});
  hand.late = 0;
  EXPECT_EQ(hand.supervise({0, 0, 2}).force.z(), 2);
  hand.late = 0.0015;
  EXPECT_EQ(hand.supervise_for(3, {0, 0, 3}).force.z(), 2);
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

TEST(supervisor, trips_at_a_position_that_is_none) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float value : {kNan, HUGE_VALF, -HUGE_VALF}) {
      Hand hand(lenient());
      hand.reading.position[axis] = value;
      expect_tripped(hand.supervise({0, 0, 0}), Rule::invalid_position);
    }
  Hand hand(lenient());
  expect_tripped(hand.supervise({0, 0, 0}, Status::invalid), Rule::invalid_position);
}

TEST(supervisor, trips_at_an_uncalibrated_device) {
  Hand hand(lenient());
  hand.state.calibrated = false;
  expect_tripped(hand.supervise({0, 0, 0}), Rule::uncalibrated);
}

TEST(supervisor, trips_at_a_force_that_is_none) {
  for (const float value : {kNan, HUGE_VALF}) {
    Hand hand(lenient());
    expect_tripped(hand.supervise({value, 0, 1}), Rule::invalid_force);
  }
}

// The verdict on a step of `length` mm.
Verdict after_step(double length, double late, const Force& force, double resolution) {
  SupervisorLimits limits = lenient();
  limits.resolution = resolution;
  Hand hand(limits);
  hand.tremor = 0;
  hand.reading.position.setZero();
  hand.supervisor.rearm();
  for (int tick = 0; tick < 2; ++tick) hand.supervise({0, 0, 0}, Status::free);
  hand.supervise(force);
  hand.reading.position.y() = static_cast<float>(length);
  hand.late = late;
  return hand.supervise(force);
}

TEST(supervisor, trips_at_a_jump_faster_than_a_hand) {
  const Force none{0, 0, 0};
  EXPECT_FALSE(after_step(4.999, 0, none, 0).trip);
  expect_tripped(after_step(5.001, 0, none, 0), Rule::jump);
  EXPECT_FALSE(after_step(5.049, 0, none, 0.025).trip) << "two resolutions";
  expect_tripped(after_step(5.051, 0, none, 0.025), Rule::jump);
  EXPECT_FALSE(after_step(9.999, 0.001, none, 0).trip) << "the tick was a period late";
  expect_tripped(after_step(10.001, 0.001, none, 0), Rule::jump);
}

TEST(supervisor, excuses_no_step_by_a_clock_that_leaps) {
  const auto after_leap = [](float step) {
    Hand hand(lenient());
    hand.supervise({0, 0, 0}, Status::free);
    hand.reading.position.x() += step;
    hand.reading.time += 3600;
    return hand.supervise({0, 0, 0}, Status::free);
  };
  EXPECT_FALSE(after_leap(104).trip) << "a period and the watchdog's 20 ms, at 5 m/s";
  expect_tripped(after_leap(106), Rule::jump);
}

TEST(supervisor, goes_by_the_force_commanded) {
  Hand hand(lenient());
  hand.supervise({0, 0, 1});
  hand.supervisor.commanded({0, 0, 0});
  hand.reading.position.x() += 2;
  EXPECT_FALSE(hand.supervise({0, 0, 1}).trip) << "too fast only under force";
  hand.reading.position.x() += 2;
  expect_tripped(hand.supervise({0, 0, 1}), Rule::velocity);
}

TEST(supervisor, trips_at_a_velocity_that_no_hand_has_under_force) {
  const Force some{0, 0, 0.01F};
  EXPECT_FALSE(after_step(0.999, 0, some, 0).trip);
  expect_tripped(after_step(1.001, 0, some, 0), Rule::velocity);
  EXPECT_FALSE(after_step(1.001, 0, {0, 0, 0}, 0).trip) << "free";
  expect_tripped(after_step(6, 0, some, 0), Rule::jump);
}

// The hand steps on by `step` mm, then every reading is the same.
int ticks_until_frozen(double step, double resolution, float force, float change_per_tick = 0) {
  SupervisorLimits limits = lenient();
  limits.resolution = resolution;
  Hand hand(limits);
  hand.tremor = 0;
  for (int tick = 0; tick < 10; ++tick) {
    hand.reading.position.x() += static_cast<float>(step);
    hand.supervise({0, 0, force});
  }
  for (int tick = 1; tick <= 1000; ++tick) {
    const Verdict verdict = hand.supervise({0, 0, force + change_per_tick * static_cast<float>(tick)});
    if (!verdict.trip) continue;
    expect_tripped(verdict, Rule::frozen_encoder);
    return tick;
  }
  return 0;
}

TEST(supervisor, trips_at_an_encoder_that_stops_dead_under_force) {
  EXPECT_EQ(ticks_until_frozen(0.161, 0.03, 1), 20);
  EXPECT_EQ(ticks_until_frozen(0.159, 0.03, 1), 0) << "a hand can stop from there";
  EXPECT_EQ(ticks_until_frozen(0.161, 0.03, 0), 0) << "no force";
  EXPECT_EQ(ticks_until_frozen(0.161, 0, 1), 0) << "no encoder";
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

  hand.reading.position.x() += 100;  // it was moved meanwhile, which is no jump
  hand.supervisor.rearm();
  EXPECT_FALSE(hand.supervisor.tripped());
  EXPECT_EQ(hand.supervise({0, 0, 1}).force.z(), 0);
  for (int tick = 0; tick < 10; ++tick) hand.supervise({0, 0, 0}, Status::free);
  EXPECT_EQ(hand.supervise({0, 0, 1}).force.z(), 1);
}

}  // namespace
}  // namespace forceshade::device
