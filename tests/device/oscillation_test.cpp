// SPDX-License-Identifier: BSD-3-Clause
#include "device/oscillation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/simulated/simulated.h"
#include "tests/device/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

constexpr double kResolution = 0.03;  // mm

// A swinging axis: mm from the middle, Hz, N per mm; what is left of the size after a second. late: s, by which the force is
// that of an earlier place; rate: Hz, of the loop.
struct Swinging {
  double size = 0.3, frequency = 40, stiffness = 1, left = 1, late = 0, rate = 1000;
};

// The gain after so many seconds of it.
double gain_after(double seconds, const Swinging& swinging, int axis = 2) {
  OscillationWatch watch(kResolution, 1 / swinging.rate);
  double gain = 1;
  for (int tick = 0; tick < seconds * swinging.rate; ++tick) {
    const double time = tick / swinging.rate;
    Eigen::Vector3f position(1, 2, 3), force(0, 0, 0);
    const auto out = [&](double at) {
      return swinging.size * std::pow(swinging.left, at) * std::sin(2 * M_PI * swinging.frequency * at);
    };
    position[axis] += static_cast<float>(out(time));
    force[axis] = static_cast<float>(1 - swinging.stiffness * out(time - swinging.late));
    gain = watch.next(position, force);
  }
  return gain;
}

TEST(oscillation, lowers_the_gain_of_what_swings_faster_than_a_hand_can) {
  for (const int axis : {0, 1, 2}) {
    EXPECT_EQ(gain_after(0.09, {}, axis), 1) << "seven swings";
    EXPECT_NEAR(gain_after(0.14, {}, axis), 0.7, 0.02);
    EXPECT_LT(gain_after(1, {}, axis), 0.05) << "and further while it goes on";
  }
}

TEST(oscillation, leaves_alone_what_is_slow_small_not_driven_or_dies_away) {
  EXPECT_EQ(gain_after(5, {.frequency = 19}), 1);
  EXPECT_LT(gain_after(5, {.frequency = 21}), 0.7);
  EXPECT_EQ(gain_after(5, {.size = 1.4 * kResolution}), 1) << "less than three resolutions from turn to turn";
  EXPECT_LT(gain_after(5, {.size = 1.7 * kResolution, .stiffness = 5}), 0.7);
  EXPECT_EQ(gain_after(5, {.stiffness = 0.15}), 1) << "0.09 N from turn to turn";
  EXPECT_LT(gain_after(5, {.stiffness = 0.2}), 0.7);
  // 0.7 within four swings of 12.5 ms is 8e-4 within a second.
  EXPECT_EQ(gain_after(5, {.size = 2, .left = 5e-4}), 1);
  EXPECT_LT(gain_after(0.3, {.size = 2, .left = 2e-3}), 0.72);
}

// A quarter of a cycle late, the force is the same at both turns.
TEST(oscillation, sees_a_force_that_changes_between_turns_and_not_at_them) {
  EXPECT_LT(gain_after(1, {.frequency = 40, .late = 1 / 160.0}), 0.3);
  EXPECT_EQ(gain_after(5, {.frequency = 40, .stiffness = 0.15, .late = 1 / 160.0}), 1) << "0.09 N";
}

TEST(oscillation, forgets_a_force_that_changed_in_an_earlier_swing) {
  OscillationWatch watch(kResolution, 0.001);
  for (int tick = 0; tick < 1000; ++tick) {
    const float out = 0.3F * std::sin(2 * static_cast<float>(M_PI) * 40 * 0.001F * static_cast<float>(tick));
    ASSERT_EQ(watch.next({0, 0, out}, {0, 0, tick < 5 ? 0.0F : 1.0F}), 1) << tick;
  }
}

// The limit cycles of a hand under late forces are at 16 to 21 Hz; what is not fed, or is as slow as a tremor, is left alone.
TEST(oscillation, sees_what_late_forces_feed_at_every_rate_of_the_loop) {
  for (const double rate : {100.0, 130.0, 200.0, 500.0, 1000.0, 4000.0}) {
    EXPECT_LT(gain_after(1, {.size = 1, .frequency = 17, .late = 0.015, .rate = rate}), 0.75) << rate;
    EXPECT_EQ(gain_after(5, {.size = 1, .frequency = 17, .rate = rate}), 1) << rate << " Hz: what is put in is given back";
    EXPECT_EQ(gain_after(5, {.size = 1, .frequency = 12, .late = 0.015, .rate = rate}), 1) << rate << " Hz: tremor";
  }
  // π K A² is given in a cycle.
  EXPECT_EQ(gain_after(5, {.size = 0.175, .frequency = 17, .late = 1 / 68.0}), 1);
  EXPECT_LT(gain_after(5, {.size = 0.185, .frequency = 17, .late = 1 / 68.0}), 0.75);
}

TEST(oscillation, gives_the_force_back_after_some_seconds_of_quiet) {
  OscillationWatch watch(kResolution, 0.001);
  double gain = 1;
  const auto rest = [&](int ticks) {
    for (int tick = 0; tick < ticks; ++tick) gain = watch.next({0, 0, 0}, {0, 0, 1});
  };
  for (int tick = 0; tick < 140; ++tick) {
    const float out = 0.3F * std::sin(2 * static_cast<float>(M_PI) * 40 * 0.001F * static_cast<float>(tick));
    gain = watch.next({0, 0, out}, {0, 0, 1 - out});
  }
  // Half a second as it is, and then a fifth in a second, smoothed by 10 ms. The last swing ends with the first tick at rest.
  int rested = 0;
  for (const auto& [ticks, expected] : {std::pair(400, 0.7), {499, 0.7}, {601, 0.718}, {1401, 0.878}, {1901, 0.978}}) {
    rest(ticks - rested);
    rested = ticks;
    EXPECT_NEAR(gain, expected, 0.003) << ticks;
  }
  rest(500);
  EXPECT_EQ(gain, 1);
}

// A hand rests on a wall of 8 N/mm and means to be 6 mm below its surface. Its swing is 0.3 mm and more where nobody watches.
TEST(oscillation, is_said_by_the_loop_and_goes_quiet) {
  const Intention rest({{0.1, {-30, 0, 3}}, {0.5, {-30, 0, -6}}, {3, {-30, 0, -6}}}, Intention::Between::minimum_jerk);
  Simulated device(premium_1_5(), Operator{Grip{}, rest, Tremor(1, 0.03), true});
  const Kept run(device, law_of(LawId::wall, 8), {.max_seconds = 3, .paced = false, .passivity = Passivity::observer});
  EXPECT_EQ(run.end_reason, EndReason::time_up) << (run.trip ? name_of(run.trip->rule) : "");
  const auto limited = run.limited_ticks[static_cast<std::size_t>(Rule::oscillation)];
  EXPECT_GT(limited, 1000U);
  std::size_t told = 0;
  float low = HUGE_VALF, high = -HUGE_VALF;
  for (const Sample& sample : run.samples) {
    told += (sample.limited >> static_cast<int>(Rule::oscillation) & 1) != 0;
    if (sample.tick < 2500) continue;
    low = std::min(low, sample.position[2]);
    high = std::max(high, sample.position[2]);
  }
  EXPECT_EQ(told, limited);
  EXPECT_LT(static_cast<double>(high - low), 3 * kResolution);
}

}  // namespace
}  // namespace forceshade::device
