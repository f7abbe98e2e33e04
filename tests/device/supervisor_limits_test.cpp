// SPDX-License-Identifier: BSD-3-Clause
// The rules that shorten a force.

#include <Eigen/Geometry>
#include <random>

#include "device/simulated/simulated.h"
#include "tests/device/supervised_hand.h"

namespace forceshade::device {
namespace {

double length_of(const Force& force) {
  return force.cast<double>().norm();
}

TEST(supervisor, passes_what_no_rule_forbids_to_the_bit) {
  Hand hand(supervisor_limits(Simulated(premium_1_5(), std::nullopt).capabilities(), kRate));
  for (int tick = 0; tick < 600; ++tick) hand.supervise({0, 0, 0}, Status::free);
  for (int tick = 0; tick < 600; ++tick) {
    const Force desired{0.1F, 0.01F, 0.003F * static_cast<float>(tick)};
    const Verdict verdict = hand.supervise(desired);
    ASSERT_EQ(verdict.force, desired);
    ASSERT_TRUE(verdict.limited.none());
  }
  EXPECT_FALSE(hand.supervisor.tripped());
}

TEST(supervisor, takes_its_limits_from_the_device_and_the_rate) {
  const SupervisorLimits limits = supervisor_limits(Simulated(premium_1_5(), std::nullopt).capabilities(), 100);
  EXPECT_EQ(limits.peak_force, 8.5);
  EXPECT_NEAR(limits.continuous_force, 1.4, 1e-7);
  EXPECT_EQ(limits.workspace_high, limits.workspace_low * -1);
  EXPECT_EQ(limits.resolution, static_cast<double>(0.03F));
  EXPECT_EQ(limits.watchdog_timeout, 0.05);
  EXPECT_EQ(supervisor_limits({}, 1000).peak_force, SupervisorLimits::kNone);
  // Below what a driver ends a run for, and never above its own.
  const SupervisorLimits low = supervisor_limits({.highest_speed = 760, .highest_slew = 400}, 1000);
  EXPECT_EQ(low.speed_under_force, 760);
  EXPECT_EQ(low.speed, 760);
  EXPECT_EQ(low.slew, 400);
  const SupervisorLimits high = supervisor_limits({.highest_speed = 1e6, .highest_slew = 1e6}, 1000);
  EXPECT_EQ(high.speed_under_force, kFastestUnderForce);
  EXPECT_EQ(high.speed, kFastest);
  EXPECT_EQ(high.slew, SupervisorLimits{}.slew);
}

TEST(supervisor, shortens_to_the_peak_force_and_keeps_the_direction) {
  SupervisorLimits limits = lenient();
  limits.peak_force = 5;
  Hand hand(limits);
  EXPECT_EQ(hand.supervise({3, 0, 4}).force, Force(3, 0, 4));
  EXPECT_EQ(hand.supervisor.count(Rule::peak_force), 0U);
  const Force longer{3.0001F, 1, -40};
  const Verdict verdict = hand.supervise(longer);
  expect_only(verdict, Rule::peak_force);
  EXPECT_LE(length_of(verdict.force), 5);
  EXPECT_GE(length_of(verdict.force), 5 * (1 - 1e-6));
  EXPECT_LE((verdict.force.normalized() - longer.normalized()).norm(), 1e-6);
  EXPECT_EQ(hand.supervisor.count(Rule::peak_force), 1U);
}

// Premium 1.5: the peak is 37 times the continuous loss, and 0.9 of the heat is reached in 1.5 s.
TEST(supervisor, allows_the_peak_shortly_and_the_continuous_force_for_ever) {
  SupervisorLimits limits = lenient();
  limits.peak_force = 8.5;
  limits.continuous_force = 1.4;
  Hand at_most(limits, 100), always(limits, 100);
  int peak_ticks = 0;
  while (at_most.supervise({0, 0, 8.5F}).force.z() == 8.5F) ++peak_ticks;
  EXPECT_NEAR(peak_ticks * 1e-2, 1.5, 0.15);
  Verdict verdict = at_most.supervise_for(360'000, {0, 0, 8.5F});
  expect_only(verdict, Rule::continuous_force);
  EXPECT_NEAR(verdict.force.z(), 1.4, 0.02 * 1.4);
  always.supervise_for(360'000, {0, 0, 1.4F});
  EXPECT_EQ(always.supervisor.count(Rule::continuous_force), 0U);
}

// A device whose thermometer gives no number may be as hot as can be.
TEST(supervisor, gives_motors_of_an_unknown_temperature_no_more_than_the_hottest) {
  SupervisorLimits limits = lenient();
  limits.peak_force = 8.5;
  limits.continuous_force = 1.4;
  Hand unknown(limits), hottest(limits), cold(limits);
  unknown.state.temperature = kNan;
  hottest.state.temperature = 2;
  const Verdict verdict = unknown.supervise({0, 0, 5});
  expect_only(verdict, Rule::warm_motors);
  EXPECT_EQ(verdict.force, hottest.supervise({0, 0, 5}).force);
  EXPECT_EQ(cold.supervise({0, 0, 5}).force.z(), 5);
}

// A millimetre to and fro at 50 Hz, under a force that the device reports to have sent; the commanded one is constant.
double swing(Hand& hand, int ticks, float sent) {
  float lowest = 1;
  for (int tick = 0; tick < ticks; ++tick) {
    const bool outward = tick / 10 % 2 == 0;
    hand.reading.position.z() += outward ? 0.1F : -0.1F;
    hand.reading.sent = Sent{.acted = {0, 0, outward ? sent : -sent}};
    lowest = std::min(lowest, hand.supervise({0, 0, 1}).force.z());
  }
  return static_cast<double>(lowest);
}

TEST(supervisor, watches_oscillation_by_the_force_that_the_device_reports) {
  Hand driven(lenient()), not_driven(lenient());
  EXPECT_LT(swing(driven, 400, 0.5F), 0.7);
  EXPECT_GT(driven.supervisor.count(Rule::oscillation), 0U);
  EXPECT_EQ(swing(not_driven, 400, 0.01F), 1);
}

// 1000 N/s at 1 kHz: a newton a tick when it grows or turns, at once when it falls.
TEST(supervisor, lets_a_force_grow_slowly_and_fall_at_once) {
  SupervisorLimits limits = lenient();
  limits.slew = 1000;
  Hand hand(limits);
  EXPECT_EQ(hand.supervise({0, 0, 0.999F}).force.z(), 0.999F);
  EXPECT_TRUE(hand.supervise({0, 0, 1.998F}).limited.none());
  const Verdict grown = hand.supervise({0, 0, 5});
  expect_only(grown, Rule::slew);
  EXPECT_NEAR(grown.force.z(), 2.998, 1e-5);
  EXPECT_EQ(hand.supervise({0, 0, 0.5F}).force.z(), 0.5F);
  EXPECT_NEAR(hand.supervise({0, 0, -5}).force.z(), -0.5, 1e-5);
  EXPECT_EQ(hand.supervise({0, 0, 0}).force, Force(0, 0, 0));
}

TEST(supervisor, lets_a_force_grow_by_a_newton_a_millisecond_unless_told_otherwise) {
  for (const double rate : {500.0, 1000.0, 4000.0}) {
    SupervisorLimits limits;
    limits.felt_free = limits.ramp_up = 0;
    Hand hand(limits, rate);
    const Verdict grown = hand.supervise({0, 0, 5});
    expect_only(grown, Rule::slew);
    EXPECT_NEAR(grown.force.z(), 1000 / rate, 1e-6) << rate;
  }
}

// Under every rule at once, to the last bit: to hold one back never gives more than the law does, nor more than a newton
// above the last.
TEST(supervisor, never_lengthens_a_force_nor_lets_it_grow_faster_than_it_may) {
  std::mt19937 bits(1);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(bits); };
  SupervisorLimits limits = supervisor_limits(Simulated(premium_1_5(), std::nullopt).capabilities(), kRate);
  limits.felt_free = 0;
  Hand hand(limits);
  double last = 0;
  std::size_t limited = 0;
  for (int tick = 0; tick < 20'000; ++tick) {
    hand.late = uniform(0, 1) < 0.2F ? 0.0011 : 0;
    hand.state.temperature = uniform(0, 1);
    const Force desired = uniform(0, 12) * Force(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    const Verdict verdict = hand.supervise(desired);
    ASSERT_FALSE(verdict.trip) << name_of(*verdict.trip);
    ASSERT_LE(length_of(verdict.force), length_of(desired)) << tick;
    ASSERT_LE(length_of(verdict.force), last + 1 + 1e-6) << tick;
    last = length_of(verdict.force);
    limited += verdict.limited.none() ? 0 : 1;
  }
  EXPECT_GT(limited, 10'000U);
  for (const Rule rule : {Rule::peak_force, Rule::warm_motors, Rule::slew, Rule::missed_deadlines, Rule::gentle_start})
    EXPECT_GT(hand.supervisor.count(rule), 100U) << name_of(rule);
}

TEST(supervisor, never_turns_a_force_faster_than_it_grows) {
  SupervisorLimits limits = lenient();
  limits.slew = 1000;
  Hand hand(limits);
  hand.supervise_for(10, {3, 0, 0});
  Force last{3, 0, 0};
  for (int tick = 0; tick < 3; ++tick) {
    const Force force = hand.supervise({-3, 0, 0}).force;
    EXPECT_LE((force - last).norm(), 1.00001F);
    EXPECT_LE(length_of(force), 3);
    last = force;
  }
  EXPECT_NEAR(last.x(), 0, 1e-4);
}

// Aimed at where only rounding decides: forces that turn by a little more than they may.
TEST(supervisor, rounds_no_force_to_a_longer_one) {
  std::mt19937 bits(1);
  std::uniform_real_distribution<float> component(-5, 5), chord(1, 1.000001F);
  SupervisorLimits limits = lenient();
  limits.slew = 1000;
  Hand hand(limits);
  std::size_t limited = 0;
  for (int i = 0; i < 2000; ++i) {
    const Force from{component(bits), component(bits), component(bits)};
    if (from.norm() < 1) continue;
    hand.supervise_for(20, from);
    const Force beside = from.cross(Force(component(bits), component(bits), component(bits))).normalized();
    const float half = std::asin(chord(bits) / (2 * from.norm()));
    const Force desired = std::cos(2 * half) * from + std::sin(2 * half) * from.norm() * beside;
    const Verdict verdict = hand.supervise(desired);
    ASSERT_LE(length_of(verdict.force), length_of(desired)) << from.transpose();
    limited += verdict.limited.has(Rule::slew) ? 1 : 0;
  }
  EXPECT_GT(limited, 1000U);
}

TEST(supervisor, fades_the_force_outside_the_workspace) {
  SupervisorLimits limits = lenient();
  limits.workspace_low = {-10, -10, -10};
  limits.workspace_high = {10, 10, 10};
  limits.workspace_margin = 4;
  limits.speed = limits.speed_under_force = SupervisorLimits::kNone;
  Hand hand(limits);
  hand.tremor = 0;
  const auto force_at = [&](float x) {
    hand.reading.position = {x, 10, -10};
    const Verdict verdict = hand.supervise({0, 0, 2});
    if (verdict.force.z() != 2) expect_only(verdict, Rule::workspace);
    return verdict.force.z();
  };
  EXPECT_EQ(force_at(10), 2);
  EXPECT_EQ(force_at(11), 1.5F);
  EXPECT_EQ(force_at(14), 0);
  EXPECT_EQ(force_at(15), 0);
  EXPECT_EQ(force_at(-12), 1);
  EXPECT_EQ(force_at(-10), 2);
  EXPECT_FALSE(hand.supervisor.tripped());
}

TEST(supervisor, gives_no_force_before_free_space_was_felt_and_then_ramps_it_in) {
  SupervisorLimits limits = lenient();
  limits.felt_free = 0.05;
  limits.ramp_up = 0.1;
  Hand hand(limits);
  expect_only(hand.supervise({0, 0, 1}), Rule::gentle_start);
  EXPECT_EQ(hand.supervise_for(1000, {0, 0, 1}).force.z(), 0);
  for (int tick = 0; tick < 49; ++tick) hand.supervise({0, 0, 0}, Status::free);
  EXPECT_EQ(hand.supervise({0, 0, 1}).force.z(), 0);
  for (int tick = 0; tick < 50; ++tick) hand.supervise({0, 0, 0}, Status::free);
  for (int tick = 1; tick <= 100; ++tick) {
    const Verdict verdict = hand.supervise({0, 0, 1});
    ASSERT_NEAR(verdict.force.z(), tick / 100.0, 1e-6);
    ASSERT_EQ(verdict.limited.has(Rule::gentle_start), tick < 100);
  }
}

TEST(supervisor, gives_no_force_without_the_dead_man_button_and_starts_gently_with_it) {
  SupervisorLimits limits = lenient();
  limits.ramp_up = 0.1;
  limits.dead_man_button = 1;
  Hand hand(limits);
  for (const std::uint16_t buttons : {std::uint16_t{0}, std::uint16_t{1}}) {
    hand.reading.buttons = buttons;
    const Verdict verdict = hand.supervise({0, 0, 1});
    expect_only(verdict, Rule::dead_man);
    EXPECT_EQ(verdict.force.z(), 0);
  }
  hand.reading.buttons = 2;
  expect_only(hand.supervise({0, 0, 1}), Rule::gentle_start);
  hand.supervise({0, 0, 0}, Status::free);
  EXPECT_NEAR(hand.supervise({0, 0, 1}).force.z(), 0.01, 1e-6);
  EXPECT_EQ(hand.supervise_for(100, {0, 0, 1}).force.z(), 1);
  hand.reading.buttons = 0;
  EXPECT_EQ(hand.supervise({0, 0, 1}).force.z(), 0);
  hand.reading.buttons = 2;
  hand.supervise({0, 0, 0}, Status::free);
  EXPECT_NEAR(hand.supervise({0, 0, 1}).force.z(), 0.01, 1e-6) << "gently again";
  EXPECT_FALSE(hand.supervisor.tripped());
}

}  // namespace
}  // namespace forceshade::device
