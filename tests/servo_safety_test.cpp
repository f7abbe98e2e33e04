// SPDX-License-Identifier: BSD-3-Clause
// The servo loop on a device that can push: supervised, and kept passive.

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "forceshade/device/simulated.h"
#include "forceshade/tests/servo_loop_fixture.h"

namespace forceshade::device {
namespace {

using tests::vector;

// A device that can push: in free space for its first `free_readings`, then 1 mm inside the wall and trembling by a count.
class Pushing : public Still {
 public:
  Capabilities capabilities() const noexcept override {
    return {.resolution = 0.03F, .peak_force = 8.5F, .continuous_force = 1.4F, .buttons = 2};
  }

 protected:
  static constexpr std::size_t kFree = 100;
  ReadResult at(std::size_t reading) noexcept override { return place(reading); }
  static Reading place(std::size_t reading) {
    const float z = reading < kFree ? 0.4F : -0.3F;
    return {{3, 0.03F * static_cast<float>(reading % 2), z}, 1e-3 * static_cast<double>(reading)};
  }
};

TEST(servo_loop, supervises_a_device_that_can_push) {
  Pushing device;
  const Kept run(device, wall(), {.max_seconds = 0.8, .paced = false});
  EXPECT_EQ(run.end_reason, EndReason::time_up);
  EXPECT_TRUE(run.supervised);
  EXPECT_EQ(run.passivity, PassivityController::Kind::damping);
  // The gentle start: 50 free ticks, then half a second in which the force grows to the law's.
  const auto limited = [&](const Sample& sample) { return (sample.limited >> static_cast<int>(Rule::gentle_start) & 1) != 0; };
  EXPECT_FALSE(limited(run.samples[99]));
  EXPECT_TRUE(limited(run.samples[100]));
  EXPECT_LT(run.samples[100].force[2], run.samples[100].law_force[2]);
  EXPECT_TRUE(limited(run.samples[548]));
  EXPECT_FALSE(limited(run.samples[549]));
  EXPECT_EQ(run.samples[549].force, run.samples[549].law_force);
  EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::gentle_start)], 449U);
  EXPECT_EQ(device.commands[100], vector(run.samples[100].force));
  EXPECT_FALSE(run.trip);
}

// Thrown half a metre a tick at tick 300, under force.
TEST(servo_loop, trip_means_zero_in_the_same_tick_and_the_end) {
  struct Thrown final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading >= 300) there.position.x() += 500;
      return there;
    }
  } device;
  const Kept run(device, wall(), unpaced());
  EXPECT_EQ(run.end_reason, EndReason::tripped);
  ASSERT_TRUE(run.trip);
  EXPECT_EQ(name_of(run.trip->rule), "jump");
  EXPECT_EQ(run.trip->tick, 300U);
  EXPECT_EQ(run.ticks, 301U);
  EXPECT_GT(device.commands[299].z(), 0);
  EXPECT_EQ(device.commands[300], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(device.commands[301], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(device.commands.size(), 302U);
  EXPECT_EQ(run.samples[300].tripped, 1 + static_cast<int>(Rule::jump));
  EXPECT_EQ(run.samples[299].tripped, 0);
  EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::jump)], 0U);
  expect_ends_at_zero_force(run);
}

// A hand that comes down fast and presses far is given less force than the supervisor would allow, for want of energy; the arm
// stands still under it, and nothing is wrong with its encoders.
TEST(servo_loop, does_not_take_a_force_that_is_withheld_for_one_that_moves_nothing) {
  const Operator hand{Grip{},
                      Intention({{0.1, {-30, 0, 5}}, {0.3, {-30, 0, -20}}, {1, {-30, 0, -20}}}, Intention::Between::straight),
                      Tremor(1, 0.03), true};
  Simulated device(premium_1_5(), hand);
  const Kept run(device, wall(), unpaced());
  EXPECT_EQ(run.end_reason, EndReason::end_of_data) << (run.trip ? name_of(run.trip->rule) : run.fault);
  EXPECT_GT(run.account.largest_change, 0.5);
}

TEST(servo_loop, trip_by_lateness_only_when_there_are_deadlines) {
  struct Slow final : Pushing {
    std::optional<Fault> on_command() noexcept override {
      if (commands.size() == 2) std::this_thread::sleep_for(std::chrono::milliseconds(60));
      return std::nullopt;
    }
  };
  Slow paced;
  const Kept late(paced, wall(), {.max_seconds = 0.2});
  ASSERT_TRUE(late.trip);
  EXPECT_EQ(late.trip->rule, Rule::watchdog);
  EXPECT_LE(late.ticks, 3U);
  Slow unhurried;
  EXPECT_EQ(Kept(unhurried, wall(), {.max_seconds = 0.2, .paced = false}).end_reason, EndReason::time_up);
}

TEST(servo_loop, gives_no_force_without_the_dead_man_button) {
  struct Held final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      there.buttons = reading < 700 ? 2 : 1;
      return there;
    }
  } device;
  const Kept run(device, wall(), {.max_seconds = 0.8, .paced = false, .dead_man_button = 1});
  EXPECT_GT(device.commands[699].z(), 0);
  EXPECT_EQ(device.commands[700], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(run.samples[700].limited, 1 << static_cast<int>(Rule::dead_man));
  Pushing same;
  for (const int button : {-1, 2})
    EXPECT_THROW(run_servo_loop(same, wall(), {.dead_man_button = button}, kNeverStop), std::invalid_argument) << button;
}

// Pressed in and let out a little higher, in turns, against a wall that the loop's hold makes active: what is asked for is
// what is done.
TEST(servo_loop, keeps_a_device_passive_as_told) {
  struct Harvester final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading > 700) there.position.z() = reading % 2 == 0 ? -1.2F : -0.3F;
      return there;
    }
  };
  const auto lowest = [](PassivityController::Kind kind) {
    Harvester device;
    const Kept run(device, wall(), {.max_seconds = 1, .paced = false, .passivity = kind});
    EXPECT_EQ(run.passivity, kind);
    EXPECT_FALSE(run.trip) << name_of(run.trip->rule);
    std::size_t altered = 0;
    for (const Sample& sample : run.samples) altered += sample.altered;
    EXPECT_EQ(altered, run.account.altered);
    return run.account.lowest_balance / run.passivity_settings.epsilon;
  };
  EXPECT_LT(lowest(PassivityController::Kind::observer), -20);
  EXPECT_GE(lowest(PassivityController::Kind::damping), -1);
  EXPECT_GE(lowest(PassivityController::Kind::tank), -1);
}

TEST(servo_loop, refuses_a_device_that_does_not_know_its_limits) {
  struct Unknowing final : Pushing {
    Capabilities capabilities() const noexcept override { return known; }
    Capabilities known = Pushing::capabilities();
  };
  const auto refuses = [](auto change) {
    Unknowing device;
    change(device.known);
    EXPECT_THROW(run_servo_loop(device, wall(), unpaced(), kNeverStop), std::invalid_argument);
    EXPECT_TRUE(device.commands.empty());
  };
  const float nan = std::nanf("");
  refuses([=](Capabilities& c) { c.peak_force = nan; });
  refuses([=](Capabilities& c) { c.continuous_force = nan; });
  refuses([=](Capabilities& c) { c.resolution = nan; });
  refuses([=](Capabilities& c) { c.friction = nan; });
  refuses([=](Capabilities& c) { c.workspace_low.z() = nan; });
  refuses([=](Capabilities& c) { c.workspace_high.x() = nan; });
}

}  // namespace
}  // namespace forceshade::device
