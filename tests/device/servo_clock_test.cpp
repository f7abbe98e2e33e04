// SPDX-License-Identifier: BSD-3-Clause
// The servo loop's report of its own time, and its behaviour when it is late, to the nanosecond: on a clock of the test's own.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

#include "device/quiet_watch.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/world/world.h"

namespace forceshade::device {
namespace {

using world::World;

constexpr std::int64_t kMillisecond = 1'000'000;  // ns

// Takes 0.1 ms to be read; at a command it does what the test says, with the number of the tick.
class Timed : public Pushing {
 public:
  Timed(World& clock, std::function<void(std::size_t)> commanded) : clock_(clock), commanded_(std::move(commanded)) {}

 private:
  ReadResult at(std::size_t reading) noexcept override {
    clock_.pass(0.1);
    return place(reading);
  }
  std::optional<Fault> on_command() noexcept override {
    commanded_(commands.size() - 1);
    return std::nullopt;
  }

  World& clock_;
  std::function<void(std::size_t)> commanded_;
};

// A command takes 0.2 ms, of which half is computing, but that of tick 5, which misses the deadline by 0.6 ms: tick 6 wakes up
// that late and makes up for it.
TEST(servo_loop, measures_each_part_of_a_tick) {
  World clock;
  Timed device(clock, [&](std::size_t tick) {
    clock.compute(0.1);
    clock.pass(tick == 5 ? 1.4 : 0.1);
  });
  const Kept run(device, wall(), {.max_seconds = 0.01});
  ASSERT_EQ(run.ticks, 10U);
  for (std::size_t k = 0; k < 10; ++k) {
    const Sample& sample = run.samples[k];
    const std::int64_t wakeup = k == 6 ? 6 * kMillisecond / 10 : 0;
    EXPECT_EQ(sample.wakeup_ns, wakeup) << k;
    EXPECT_EQ(sample.wall_ns, static_cast<std::int64_t>(k) * kMillisecond + wakeup + kMillisecond / 10) << k;
    EXPECT_EQ(sample.compute_ns, k == 5 ? 15 * kMillisecond / 10 : 2 * kMillisecond / 10) << k;
    EXPECT_EQ(sample.late, k == 5 ? 1 : 0) << k;
  }
  EXPECT_EQ(run.missed_deadlines, 1U);
  EXPECT_EQ(run.overruns, 0U) << "it waited and did not compute";
  EXPECT_EQ(run.wakeup_us.max, 600);
  EXPECT_EQ(run.compute_us.max, 1500);
  EXPECT_EQ(run.tick_us.max, 1600);
  EXPECT_EQ(run.wakeup_us.p50, 0);
  EXPECT_NEAR(run.compute_us.p50, 200, 200.0 / 32);
  EXPECT_NEAR(run.tick_us.p50, 300, 300.0 / 32);
  // Until the zero force that ends it has been commanded.
  EXPECT_EQ(run.samples.back().wall_ns, 10 * kMillisecond + 2 * kMillisecond / 10);
  EXPECT_NEAR(run.achieved_rate_hz, 10 / 0.0102, 1e-9);
}

// Tick 5 takes 3.4 ms: tick 6 begins 3 periods after it instead of one, and of the two that follow at once no time passes.
TEST(servo_loop, counts_the_periods_that_passed_for_damping) {
  World clock;
  Timed device(clock, [&](std::size_t tick) { clock.pass(tick == 5 ? 3.4 : 0.1); });
  const Kept run(device, wall(), {.max_seconds = 0.012, .damping = {.damping = 0.001F}});
  ASSERT_EQ(run.ticks, 12U);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(run.samples[k].periods(), k == 6 ? 3U : k == 7 || k == 8 ? 0U : 1U) << k;
  EXPECT_TRUE(std::isnan(run.damped_energy.most)) << "nothing is proved of late ticks";
}

// Tick 100 jumps into the wall.
TEST(servo_loop, has_no_velocity_to_damp_after_more_than_sixteen_periods) {
  for (const auto& [late, is_damped] : {std::pair{16.0, true}, {17.0, false}, {40.0, false}}) {
    World clock;
    Timed device(clock, [&, late = late](std::size_t tick) { clock.pass(tick == 99 ? late : 0.1); });
    const Kept run(device, wall(), {.max_seconds = 0.13, .damping = {.damping = 0.001F}});
    ASSERT_GT(run.samples.size(), 100U);
    const float spring = wall().evaluate({0, 0, -0.3F}).force.z();
    EXPECT_EQ(run.samples[100].law_force[2] > spring, is_damped) << late;
    EXPECT_GE(run.samples[100].law_force[2], spring) << late;
    EXPECT_EQ(run.samples[100].periods(), std::min(late, 17.0)) << "17 stands for all above";
  }
}

TEST(servo_loop, counts_an_overrun_only_if_it_computed_for_longer_than_a_period) {
  for (const auto& [computed, overruns] : {std::pair{0.99, 0U}, std::pair{1.0, 0U}, std::pair{1.01, 1U}}) {
    World clock;
    Timed device(clock, [&, computed = computed](std::size_t tick) {
      if (tick != 5) return;
      clock.compute(computed);
      clock.pass(0.5);
    });
    const Kept run(device, wall(), {.max_seconds = 0.01});
    EXPECT_EQ(run.missed_deadlines, 1U) << computed;
    EXPECT_EQ(run.overruns, overruns) << computed;
  }
}

TEST(servo_loop, has_no_deadlines_and_no_overruns_where_it_is_not_paced) {
  World clock;
  Timed device(clock, [&](std::size_t) { clock.compute(3); });
  const Kept run(device, wall(), {.max_seconds = 0.01, .paced = false});
  EXPECT_EQ(run.ticks, 10U);
  EXPECT_EQ(run.missed_deadlines, 0U);
  EXPECT_EQ(run.overruns, 0U);
  EXPECT_FALSE(run.trip);
}

// Tick 6 is late by `late` ms, and those after it make up for it.
std::optional<Rule> trip_of(double rate, double late, std::optional<double> timeout = std::nullopt) {
  World clock;
  Timed device(clock, [&](std::size_t tick) {
    if (tick == 5) clock.pass(1000 / rate - 0.1 + late);
  });
  const Kept run(device, wall(), {.rate_hz = rate, .max_seconds = 50 / rate, .watchdog_timeout = timeout});
  EXPECT_EQ(run.ticks, run.trip ? 7U : 50U);
  return run.trip ? std::optional(run.trip->rule) : std::nullopt;
}

TEST(servo_loop, trips_when_a_tick_is_later_than_the_watchdog_timeout) {
  EXPECT_EQ(trip_of(1000, 19.9), std::nullopt);
  EXPECT_EQ(trip_of(1000, 20.1), Rule::watchdog);
  EXPECT_EQ(trip_of(100, 35), std::nullopt) << "five periods";
  EXPECT_EQ(trip_of(100, 50.1), Rule::watchdog);
  EXPECT_EQ(trip_of(1000, 25, 0.03), std::nullopt);
  EXPECT_EQ(trip_of(1000, 30.1, 0.03), Rule::watchdog);
  EXPECT_EQ(trip_of(1000, 5.1, 0.005), Rule::watchdog);
}

class TimedInASimulation final : public Timed {
 public:
  using Timed::Timed;
  Capabilities capabilities() const noexcept override {
    Capabilities capabilities = Timed::capabilities();
    capabilities.moves_an_arm = false;
    return capabilities;
  }
};

// Tick 205 takes 60.1 ms, and the ticks after it make up for it.
TEST(servo_loop, only_counts_late_ticks_of_a_device_that_moves_no_arm_where_no_timeout_is_given) {
  for (const std::optional<double> timeout : {std::optional<double>(), std::optional(0.02)}) {
    World clock;
    TimedInASimulation device(clock, [&](std::size_t tick) {
      if (tick == 205) clock.pass(60);
    });
    const Kept run(device, wall(), {.max_seconds = 0.5, .watchdog_timeout = timeout});
    EXPECT_EQ(run.acts_on_lateness, timeout.has_value());
    EXPECT_EQ(run.trip.has_value(), timeout.has_value());
    EXPECT_EQ(run.ticks, timeout ? 207U : 500U);
    EXPECT_EQ(run.missed_deadlines, timeout ? 2U : 66U);
    EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::missed_deadlines)], 0U);
    EXPECT_EQ(run.worst_delay.tick, 206U);
    EXPECT_DOUBLE_EQ(run.worst_delay.late_ms, 59.1);
  }
}

// A tick of 30.1 ms, of which so much was computing, delays the next one; or the system sleeps for longer than it was told to.
TEST(servo_loop, states_the_longest_delay_and_what_the_tick_before_took) {
  struct Case {
    double computed, waited, overslept;
    Delay expected;
  };
  for (const auto& [computed, waited, overslept, expected] :
       {Case{0.5, 29.5, 0, {.tick = 6, .late_ms = 29.1, .before_ms = 30.1, .computed_ms = 0.5}},
        Case{29, 1, 0, {.tick = 6, .late_ms = 29.1, .before_ms = 30.1, .computed_ms = 29}},
        Case{0, 0, 10, {.tick = 6, .late_ms = 10, .before_ms = 0.1, .computed_ms = 0}}}) {
    World clock;
    Timed device(clock, [&, computed = computed, waited = waited, overslept = overslept](std::size_t tick) {
      if (tick != 5) return;
      clock.compute(computed);
      clock.pass(waited);
      clock.oversleep(overslept);
    });
    const Delay delay = Kept(device, wall(), {.max_seconds = 0.1}).worst_delay;
    EXPECT_EQ(delay.tick, expected.tick);
    EXPECT_NEAR(delay.late_ms, expected.late_ms, 1e-9);
    EXPECT_NEAR(delay.before_ms, expected.before_ms, 1e-9);
    EXPECT_NEAR(delay.computed_ms, expected.computed_ms, 1e-9);
  }
}

// But the one that stops a run is not slept through: the force is zero at once.
TEST(servo_loop, sleeps_on_after_a_signal) {
  World clock;
  std::atomic<bool> stop = false;
  Timed device(clock, [&](std::size_t tick) {
    stop = tick == 3;
    clock.interrupt(tick == 3 ? 1 : 3);
  });
  const Kept run(device, wall(), {.rate_hz = 100, .max_seconds = 0.5}, stop);
  EXPECT_EQ(run.end_reason, EndReason::stopped);
  ASSERT_EQ(run.ticks, 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(run.samples[k].wakeup_ns, 0) << k;
  EXPECT_EQ(run.samples.back().wall_ns, 3 * 10 * kMillisecond + kMillisecond / 10);
}

// Frames every 1.02 ms from 0.7 ms after the start on, whatever the loop does.
class Framed final : public Pushing {
 public:
  Framed(World& clock, std::function<void(std::size_t)> commanded) : clock_(clock), commanded_(std::move(commanded)) {}
  Capabilities capabilities() const noexcept override {
    Capabilities can = Pushing::capabilities();
    can.paces = true;
    return can;
  }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override {
    ++waits;
    frame_ = std::max(frame_ + 1, (clock_.now() - first_) / period);
    system::sleep_until(std::min(first_ + frame_ * period, deadline));
    return first_ + frame_ * period;
  }
  std::int64_t period = 1'020'000;   // ns
  std::vector<std::int64_t> frames;  // that were read
  int waits = 0;

 private:
  ReadResult at(std::size_t reading) noexcept override {
    frames.push_back(frame_);
    return place(reading);
  }
  std::optional<Fault> on_command() noexcept override {
    commanded_(commands.size() - 1);
    return std::nullopt;
  }

  World& clock_;
  std::function<void(std::size_t)> commanded_;
  std::int64_t first_ = clock_.now() + 7 * kMillisecond / 10, frame_ = -1;
};

TEST(servo_loop, follows_the_frames_of_a_device_that_paces) {
  World clock;
  // Tick 5 takes as long as three frames and a bit: the two that began meanwhile and are over are missed.
  Framed device(clock, [&](std::size_t tick) { clock.pass(tick == 5 ? 3.1 : 0.2); });
  const Kept run(device, wall(), {.max_seconds = 0.01, .damping = {.drag = 0.001F}});
  EXPECT_TRUE(run.followed_device);
  EXPECT_EQ(device.frames, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 8, 9, 10, 11}));
  EXPECT_EQ(run.missed_deadlines, 1U);
  EXPECT_EQ(run.samples[4].wakeup_ns, 0);
  EXPECT_EQ(run.samples[6].wakeup_ns, 40'000) << "frame 8 began then";
  for (std::size_t k = 1; k < 10; ++k)
    EXPECT_EQ(run.samples[k].periods(), device.frames[k] - device.frames[k - 1]) << k << ": as damping counts them";
}

// Frames that are a little early are as many periods as those that are a little late.
TEST(servo_loop, counts_the_nearest_number_of_periods_between_two_frames) {
  struct Case {
    std::int64_t period;  // ns
    double took;          // ms, the tick before
    std::int64_t frames;
    std::uint32_t periods;
  };
  for (const auto& [period, took, frames, periods] : {Case{980'000, 3.1, 3, 3}, {800'000, 1.7, 2, 2}, {700'000, 1.5, 2, 1}}) {
    World clock;
    Framed device(clock, [&, its = took](std::size_t tick) { clock.pass(tick == 5 ? its : 0.2); });
    device.period = period;
    const Kept run(device, wall(), {.max_seconds = 0.01, .damping = {.drag = 0.001F}});
    EXPECT_EQ(run.samples[6].periods(), periods) << period;
    EXPECT_EQ(device.frames[6] - device.frames[5], frames) << period;
  }
}

TEST(servo_loop, follows_its_own_clock_where_it_is_told_to_or_where_nothing_is_paced) {
  for (const auto& [follows, paced] : {std::pair{false, true}, {true, false}}) {
    World clock;
    Framed device(clock, [&](std::size_t) { clock.pass(0.2); });
    const Kept run(device, wall(), {.max_seconds = 0.01, .paced = paced, .follows_device = follows});
    EXPECT_FALSE(run.followed_device);
    EXPECT_EQ(device.waits, 0);
    EXPECT_EQ(run.ticks, 10U);
  }
}

// Each is waited for 0.1 s, and there should be a thousand.
TEST(quiet_watch, waits_for_frames_that_do_not_come_for_twice_its_time_and_a_second) {
  struct Frameless final : Pushing {
    Capabilities capabilities() const noexcept override {
      Capabilities can = Pushing::capabilities();
      can.paces = true;
      return can;
    }
    std::int64_t wait_for_frame(std::int64_t deadline) noexcept override {
      system::sleep_until(deadline);
      return deadline;
    }
  } device;
  World clock;
  const std::int64_t begin = clock.now();
  observe_without_force(device, 1000, 1, kNeverStop);
  EXPECT_EQ(clock.now() - begin, 3000 * kMillisecond);
}

TEST(servo_loop, waits_no_longer_for_a_frame_once_it_is_stopped) {
  World clock;
  std::atomic<bool> stop = false;
  Framed device(clock, [&](std::size_t tick) { stop = tick == 7; });
  const Kept run(device, wall(), {.max_seconds = 1}, stop);
  EXPECT_EQ(run.end_reason, EndReason::stopped);
  EXPECT_EQ(run.ticks, 8U);
  EXPECT_EQ(device.waits, 8);
}

}  // namespace
}  // namespace forceshade::device
