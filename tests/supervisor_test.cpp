// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "forceshade/device/null.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/simulated.h"
#include "forceshade/fast/law.h"

namespace forceshade::device {
namespace {

using Force = Eigen::Vector3f;

constexpr double kRate = 1000;
const float kNan = std::nanf("");

double length_of(const Force& force) {
  return force.cast<double>().norm();
}

// No rule but those the test asks for.
SupervisorLimits lenient() {
  SupervisorLimits limits;
  limits.slew = SupervisorLimits::kNone;
  limits.felt_free = limits.ramp_up = 0;
  return limits;
}

// A hand in contact that trembles by a count, past its gentle start.
class Hand {
 public:
  explicit Hand(const SupervisorLimits& limits, double rate = kRate) : supervisor(limits, rate) {
    for (int tick = 0; tick < 2; ++tick) supervise({0, 0, 0}, Status::free);
  }

  Verdict supervise(const Force& wanted, Status status = Status::contact) {
    reading.position.y() += tremor;
    tremor = -tremor;
    return supervisor.supervise(reading, state, wanted, status, late);
  }
  Verdict supervise_for(int ticks, const Force& wanted) {
    Verdict verdict;
    for (int tick = 0; tick < ticks; ++tick) verdict = supervise(wanted);
    return verdict;
  }

  Supervisor supervisor;
  Reading reading{.position = {1, 2, -1}};
  State state;
  double late = 0;
  float tremor = 0.03F;
};

void expect_only(const Verdict& verdict, Rule rule) {
  for (std::size_t i = 0; i < kRules; ++i) {
    const Rule other = static_cast<Rule>(i);
    EXPECT_EQ(verdict.limited.has(other), other == rule) << name_of(other);
  }
}

void expect_tripped(const Verdict& verdict, Rule rule) {
  ASSERT_TRUE(verdict.trip) << name_of(rule);
  EXPECT_EQ(name_of(*verdict.trip), name_of(rule));
  EXPECT_EQ(verdict.force, Force(0, 0, 0));
}

TEST(supervisor, passes_what_no_rule_forbids_to_the_bit) {
  Hand hand(supervisor_limits(Simulated(premium_1_5(), std::nullopt).capabilities(), kRate));
  for (int tick = 0; tick < 600; ++tick) hand.supervise({0, 0, 0}, Status::free);
  for (int tick = 0; tick < 600; ++tick) {
    const Force wanted{0.1F, 0.01F, 0.003F * static_cast<float>(tick)};
    const Verdict verdict = hand.supervise(wanted);
    ASSERT_EQ(verdict.force, wanted);
    ASSERT_TRUE(verdict.limited.none());
  }
  EXPECT_FALSE(hand.supervisor.tripped());
}

TEST(supervisor, names_every_rule_once) {
  for (std::size_t i = 0; i < kRules; ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(name_of(static_cast<Rule>(i)), name_of(static_cast<Rule>(j)));
}

TEST(supervisor, takes_its_limits_from_the_device_and_the_rate) {
  const SupervisorLimits limits = supervisor_limits(Simulated(premium_1_5(), std::nullopt).capabilities(), 100);
  EXPECT_EQ(limits.peak_force, 8.5);
  EXPECT_NEAR(limits.continuous_force, 1.4, 1e-7);
  EXPECT_EQ(limits.workspace_high, limits.workspace_low * -1);
  EXPECT_EQ(limits.patience, 0.05);
  EXPECT_EQ(supervisor_limits({}, 1000).peak_force, SupervisorLimits::kNone);
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
  Hand at_most(limits), always(limits);
  int peak_ticks = 0;
  while (at_most.supervise({0, 0, 8.5F}).force.z() == 8.5F) ++peak_ticks;
  std::printf("  peak force for %.2f s\n", peak_ticks * 1e-3);
  EXPECT_NEAR(peak_ticks * 1e-3, 1.5, 0.15);
  Verdict verdict = at_most.supervise_for(3'600'000, {0, 0, 8.5F});
  expect_only(verdict, Rule::continuous_force);
  EXPECT_NEAR(verdict.force.z(), 1.4, 0.02 * 1.4);
  always.supervise_for(3'600'000, {0, 0, 1.4F});
  EXPECT_EQ(always.supervisor.count(Rule::continuous_force), 0U);
}

TEST(supervisor, stays_warm_when_rearmed) {
  SupervisorLimits limits = lenient();
  limits.peak_force = 8.5;
  limits.continuous_force = 1.4;
  Hand hand(limits);
  hand.supervise_for(60'000, {0, 0, 8.5F});
  hand.supervise({0, 0, kNan});
  hand.supervisor.rearm();
  hand.supervise_for(2, {0, 0, 0});
  hand.supervise({0, 0, 0}, Status::free);
  hand.supervise({0, 0, 0}, Status::free);
  EXPECT_LT(hand.supervise({0, 0, 8.5F}).force.z(), 3);
}

TEST(supervisor, derates_motors_that_say_they_are_warm) {
  SupervisorLimits limits = lenient();
  limits.peak_force = 8.5;
  limits.continuous_force = 1.4;
  Hand hand(limits);
  const auto most_at = [&](float temperature) {
    hand.state.temperature = temperature;
    const Verdict verdict = hand.supervise({0, 0, 8.5F});
    if (verdict.force.z() != 8.5F) expect_only(verdict, Rule::warm_motors);
    return verdict.force.z();
  };
  EXPECT_EQ(most_at(0.9F), 8.5F);
  EXPECT_LT(most_at(0.91F), 8.0F);
  EXPECT_NEAR(most_at(1), 1.4, 1e-5);
  EXPECT_EQ(most_at(1.1F), 0);
  EXPECT_EQ(most_at(kNan), 0);
  EXPECT_EQ(most_at(0), 8.5F);
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
  EXPECT_FALSE(hand.supervisor.tripped());
}

TEST(supervisor, starts_gently_after_the_device_switched_its_forces_off) {
  Hand hand(lenient());
  EXPECT_EQ(hand.supervise({0, 0, 1}).force.z(), 1);
  hand.state.forces_on = false;
  expect_only(hand.supervise({0, 0, 1}), Rule::dead_man);
  hand.state.forces_on = true;
  expect_only(hand.supervise({0, 0, 1}), Rule::gentle_start);
}

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

// Runs a device under the default rules and counts the ticks that a rule other than `expected` limited.
std::size_t limited_ticks(Device& device, LawId id, int ticks, std::optional<Rule> expected = std::nullopt) {
  const auto law = std::get<fast::Law>(fast::Law::build(id, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F}));
  Supervisor supervisor(supervisor_limits(device.capabilities(), kRate), kRate);
  device.start(kRate);
  std::size_t limited = 0, limited_as_expected = 0;
  int still = 0, longest_still = 0;
  Eigen::Vector3f before{0, 0, 0};
  for (int tick = 0; tick < ticks; ++tick) {
    const Reading reading = std::get<Reading>(device.read());
    const fast::Evaluation wanted = law.evaluate(reading.position);
    const Verdict verdict = supervisor.supervise(reading, device.state(), wanted.force, wanted.status, 0);
    if (verdict.trip) ADD_FAILURE() << name_of(*verdict.trip) << " at tick " << tick << ", " << name_of(id);
    if (verdict.trip) break;
    if (!verdict.limited.none()) ++(expected && verdict.limited.has(*expected) ? limited_as_expected : limited);
    device.command(verdict.force);
    still = reading.position == before && !verdict.force.isZero(0) ? still + 1 : 0;
    longest_still = std::max(longest_still, still);
    before = reading.position;
  }
  std::printf("  %s: under force without a changed bit for %d ticks\n", std::string(name_of(id)).c_str(), longest_still);
  if (expected) {
    std::printf("  %s: %s in %zu of %d ticks\n", std::string(name_of(id)).c_str(), std::string(name_of(*expected)).c_str(),
                limited_as_expected, ticks);
    EXPECT_GT(limited_as_expected, 0U);
  }
  return limited;
}

// On the ridge of bump-2p the force jumps by two newtons at the depth of these strokes: it is turned within a few ticks.
TEST(supervisor, leaves_ordinary_strokes_alone) {
  for (const LawName& law : kLaws) {
    const auto expected = law.id == LawId::bump_2p ? std::optional(Rule::slew) : std::nullopt;
    EXPECT_EQ(limited_ticks(*open_device("simulated"), law.id, 10'000, expected), 0U) << law.name;
  }
  EXPECT_EQ(limited_ticks(*open_device("simulated:omni"), LawId::bump_1p_shaded, 60'000), 0U);
}

TEST(supervisor, leaves_a_hand_at_rest_alone) {
  for (const auto& make : kModels)
    for (const double tremor : {0.0, 0.03, 0.1}) {
      const Intention rest({{0, {3, 0, 5}}, {1, {3, 0, 5}}, {2, {3, 0, -3}}}, Intention::Between::minimum_jerk);
      Simulated device(make(), Operator{Grip{}, rest, Tremor(1, tremor), false});
      EXPECT_EQ(limited_ticks(device, LawId::wall, 20'000), 0U) << make().name;
    }
}

TEST(supervisor, leaves_a_null_device_alone) {
  for (const LawName& law : kLaws) {
    Null device;
    limited_ticks(device, law.id, 5'000);
  }
}

}  // namespace
}  // namespace forceshade::device
