// SPDX-License-Identifier: BSD-3-Clause
// The servo loop on a device that can push: supervised, and kept passive.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "device/passivity_controller.h"
#include "device/sent_forces.h"
#include "device/simulated/simulated.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using tests::vector;

// The gentle start: 50 ms of free space, then half a second in which the force grows to the law's, whatever the rate is; and a
// step of the energy account is what a hand goes in one period. The device is free for its first hundred readings.
TEST(servo_loop, supervises_a_device_that_can_push_and_counts_seconds_at_its_own_rate) {
  for (const auto& [rate, last_limited] : {std::pair{1000.0, 548U}, {2000.0, 1098U}}) {
    Pushing device;
    const Kept run(device, wall(), {.rate_hz = rate, .max_seconds = 0.8, .paced = false});
    EXPECT_EQ(run.end_reason, EndReason::time_up);
    ASSERT_EQ(static_cast<double>(run.ticks), 0.8 * rate);
    EXPECT_TRUE(run.supervised);
    EXPECT_EQ(run.passivity, Passivity::damping);
    EXPECT_EQ(run.passivity_settings.longest_step, passivity_settings(device.capabilities(), rate).longest_step);
    const auto limited = [&](std::size_t k) {
      return (run.samples[k].limited >> static_cast<int>(Rule::gentle_start) & 1) != 0;
    };
    EXPECT_FALSE(limited(99));
    EXPECT_TRUE(limited(100));
    EXPECT_LT(run.samples[100].force[2], run.samples[100].law_force[2]);
    EXPECT_TRUE(limited(last_limited));
    EXPECT_FALSE(limited(last_limited + 1));
    EXPECT_EQ(run.samples[last_limited + 1].force, run.samples[last_limited + 1].law_force);
    EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::gentle_start)], last_limited - 99);
    EXPECT_EQ(device.commands[100], vector(run.samples[100].force));
    EXPECT_FALSE(run.trip);
  }
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

// Pressed in and let out a little higher, in turns, against a wall that the loop's hold makes active.
struct Harvester final : Pushing {
  ReadResult at(std::size_t reading) noexcept override {
    Reading there = place(reading);
    if (reading > 700) there.position.z() = reading % 2 == 0 ? -1.2F : -0.3F;
    return there;
  }
};

TEST(servo_loop, keeps_a_device_passive_as_told) {
  const auto lowest = [](Passivity kind) {
    Harvester device;
    const Kept run(device, wall(), {.max_seconds = 1, .paced = false, .passivity = kind});
    EXPECT_EQ(run.passivity, kind);
    EXPECT_FALSE(run.trip) << name_of(run.trip->rule);
    std::size_t altered = 0;
    for (const Sample& sample : run.samples) altered += sample.altered;
    EXPECT_EQ(altered, run.account.altered);
    return run.account.lowest_balance / run.passivity_settings.epsilon;
  };
  EXPECT_LT(lowest(Passivity::observer), -5) << "although the supervisor takes it for a limit cycle";
  EXPECT_GE(lowest(Passivity::damping), -1);
  EXPECT_GE(lowest(Passivity::tank), -1);
}

TEST(servo_loop, gives_the_device_and_the_record_the_force_that_the_controller_left) {
  Harvester device;
  const Kept run(device, law_of(LawId::wall, 8), {.max_seconds = 1, .paced = false});
  ASSERT_GT(run.account.altered, 10U);
  ASSERT_EQ(device.commands.size(), run.samples.size());
  double peak = 0, given = 0;
  for (std::size_t k = 0; k < run.samples.size(); ++k) {
    const Eigen::Vector3f force = vector(run.samples[k].force);
    ASSERT_EQ(device.commands[k], force) << k;
    peak = std::max(peak, force.cast<double>().norm());
    // The force that was held moved the hand from reading to reading; the last sample repeats the last position.
    if (k > 0)
      given += vector(run.samples[k - 1].force)
                   .cast<double>()
                   .dot(vector(run.samples[k].position).cast<double>() - vector(run.samples[k - 1].position).cast<double>());
  }
  EXPECT_EQ(run.peak_force_N, peak);
  EXPECT_NEAR(run.energy_given_mJ() - run.energy_taken_mJ(), given, 1e-9);
}

// A hand that rests in a stiff wall is given little force, since it has put in no energy; then it presses on and puts in much.
// The supervisor goes by the force that was commanded, not by the one that it had allowed.
TEST(servo_loop, lets_the_commanded_force_grow_no_faster_than_the_supervisor_allows) {
  struct Presser final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading > 700) there.position.z() -= static_cast<float>(std::min<std::size_t>(reading - 700, 8));
      return there;
    }
  };
  for (const Passivity kind : {Passivity::damping, Passivity::tank}) {
    Presser device;
    const Kept run(device, law_of(LawId::wall, 8), {.max_seconds = 1, .paced = false, .passivity = kind});
    ASSERT_FALSE(run.trip) << name_of(run.trip->rule);
    double last = 0, most = 0;
    std::size_t withheld = 0;
    for (const Sample& sample : run.samples) {
      const double force = vector(sample.force).cast<double>().norm();
      withheld += sample.altered;
      most = std::max(most, force - last);
      last = force;
    }
    EXPECT_GT(withheld, 50U);
    EXPECT_LE(most, 1 + 1e-6);
    EXPECT_GT(most, 0.99);
  }
}

// To and fro in a wall far too stiff for it, until nothing is left of the force; a hand is then free to go faster than any may
// under force.
TEST(servo_loop, holds_no_speed_against_a_hand_that_was_given_no_force) {
  struct Leaver final : Pushing {
    ReadResult at(std::size_t reading) noexcept override {
      Reading there = place(reading);
      if (reading > 700) there.position.z() = reading % 2 == 0 ? -0.3F : -1.2F;
      if (reading > 900) there.position.x() += 2 * static_cast<float>(reading - 900);
      return there;
    }
  } device;
  const Kept run(device, law_of(LawId::wall, 8), {.max_seconds = 0.95, .paced = false});
  EXPECT_EQ(vector(run.samples[900].force), Eigen::Vector3f(0, 0, 0));
  EXPECT_NE(vector(run.samples[900].law_force), Eigen::Vector3f(0, 0, 0));
  EXPECT_FALSE(run.trip) << name_of(run.trip->rule);
}

// Goes its own way, in mm and s, whatever the force. With latency it has frames: one a reading, which clamp and report.
class OnItsWay final : public Device {
 public:
  struct Place {
    double time;
    Eigen::Vector3f position;
  };
  OnItsWay(std::vector<Place> way, bool latency) : latency_(latency), way_(std::move(way)) {}

  Capabilities capabilities() const noexcept override {
    return {.resolution = 0.03F, .peak_force = 8.5F, .continuous_force = 8.5F, .latency = latency_};
  }
  std::optional<Fault> start(double) noexcept override { return std::nullopt; }
  ReadResult read() noexcept override {
    if (next_ == way_.size()) return EndOfData{};
    Reading reading{.position = way_[next_].position, .time = way_[next_].time};
    ++next_;
    if (!latency_) return reading;
    frames_.arrived(reading.position.cast<double>());
    frames_.send(command_.cast<double>());
    reading.sent = frames_.report();
    return reading;
  }
  void allow(const Allowance& allowance) noexcept override {
    allowed = allowance.work;
    frames_.allow(allowance);
  }
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    command_ = force;
    return std::nullopt;
  }
  double allowed = 0;  // mJ

 private:
  bool latency_;
  std::vector<Place> way_;
  std::size_t next_ = 0;
  SentForces frames_;
  Eigen::Vector3f command_{0, 0, 0};
};

// From free space to a depth and back up, at so many mm/s, and down again at 100 mm/s. Between two readings on the way up,
// after `at` mm of it, so many ms are missing; the device's clock shows it, or does not.
std::vector<OnItsWay::Place> stalled(double depth, double speed, double at, int missing, bool shown = true) {
  std::vector<OnItsWay::Place> way;
  double time = 0, z = 0.4;
  const auto stay = [&] {
    way.push_back({time, {3, 0, static_cast<float>(z)}});
    time += 0.001;
  };
  for (int tick = 0; tick < 100; ++tick) stay();
  for (; z > -depth; z -= 0.01) stay();
  for (int tick = 0; tick < 100; ++tick) stay();
  const double top = -depth + at;
  for (; speed > 0 && z < top; z += 0.001 * speed) stay();
  z += 0.001 * speed * missing;
  time += shown ? 0.001 * missing : 0;
  for (int tick = 0; tick < 5; ++tick) stay();
  for (const double bottom = -depth - 12; z > bottom; z -= 0.1) stay();
  return way;
}

// After one stall of whatever length, the hand that pushes has half of the force
// again 12 mm below where it came from, or the run says why not.
// 12 ms at 0.5 m/s once left none for the rest of the run.
TEST(servo_loop, gives_force_again_after_any_stall_or_says_why_not) {
  std::size_t trips = 0, forgiving = 0;
  for (const bool latency : {false, true})
    for (const auto kind : {Passivity::damping, Passivity::tank})
      for (const double depth : {4.0, 8.0})
        for (const double speed : {50.0, 500.0, 990.0, -500.0})
          for (const double at : {0.0, 2.0})
            for (const int missing : {1, 3, 5, 12, 19, -1, -12}) {
              OnItsWay device(stalled(depth, speed, speed > 0 ? at : 0, std::abs(missing), missing > 0), latency);
              const Kept run(device, wall(), {.paced = false, .passivity = kind});
              const auto words = std::to_string(missing) + " ms at " + std::to_string(speed) + " mm/s, " +
                                 std::string(name_of(kind)) + (latency ? ", latency" : "");
              trips += run.end_reason == EndReason::tripped;
              forgiving += run.account.forgiven > 0;
              if (run.end_reason == EndReason::tripped) continue;
              EXPECT_EQ(run.end_reason, EndReason::end_of_data) << words;
              const Sample& last = run.samples[run.ticks - 1];
              EXPECT_GT(last.force[2], 0.5F * last.law_force[2]) << words;
              EXPECT_GE(run.account.lowest_balance, -run.passivity_settings.epsilon - run.account.forgiven) << words;
              EXPECT_EQ(device.allowed, run.passivity_settings.epsilon + run.account.forgiven) << words;
              EXPECT_GE(-run.account.net(), -run.passivity_settings.epsilon - run.account.forgiven) << words;
            }
  EXPECT_GT(forgiving, 20U);
  EXPECT_GT(trips, 20U) << "by speed, where no clock excused it";
}

// The account is overdrawn by 8 N over 19 mm again and again: what is forgiven has an end, and the end has words.
TEST(servo_loop, trips_when_too_much_is_forgiven) {
  std::vector<OnItsWay::Place> way;
  for (int again = 0; again < 10; ++again) {
    for (const OnItsWay::Place& place : stalled(15, 900, 0.9, 12)) {
      const double time = way.empty() ? 0 : way.back().time + 0.001;
      const bool stalls = place.time > 0 && !way.empty() && place.position.z() - way.back().position.z() > 2;
      way.push_back({time + (stalls ? 0.012 : 0), place.position});
    }
    while (way.back().position.z() < 0.4F)
      way.push_back({way.back().time + 0.001, way.back().position + Eigen::Vector3f(0, 0, 0.1F)});
  }
  OnItsWay device(way, false);
  const Kept run(device, wall(), {.paced = false});
  ASSERT_TRUE(run.trip);
  EXPECT_EQ(name_of(run.trip->rule), "energy");
  EXPECT_EQ(run.limited_ticks[static_cast<std::size_t>(Rule::energy)], 0U) << "it tripped, and limited nothing";
  EXPECT_GT(run.account.owed(), 100);
  EXPECT_GT(run.account.forgiven, 90);
  EXPECT_LT(run.account.owed(), 100 + 8.5 * 13);
  expect_ends_at_zero_force(run);
}

// Out of a wall at 3 m/s: two readings after it was left, the force of the last reading in it has acted for the whole step.
TEST(servo_loop, trips_where_a_hand_is_pushed_on_its_way_out_faster_than_any_may_be) {
  std::vector<OnItsWay::Place> way = stalled(5, 900, 0, 0);
  way.resize(way.size() - 100);  // still down there
  const auto rise = [&](float step) {
    way.push_back({way.back().time + 0.001, way.back().position + Eigen::Vector3f(0, 0, step)});
  };
  while (way.back().position.z() < 0) rise(0.9F);
  rise(3);
  rise(3);
  OnItsWay device(way, true);
  const Kept run(device, wall(), {.paced = false});
  ASSERT_TRUE(run.trip);
  EXPECT_EQ(name_of(run.trip->rule), "velocity");
  EXPECT_EQ(run.trip->tick, way.size() - 2);
  EXPECT_EQ(vector(run.samples[run.trip->tick - 1].law_force), Eigen::Vector3f(0, 0, 0)) << "nothing was commanded any more";
}

// Its other limits are tried in the fault campaign.
TEST(servo_loop, refuses_a_device_that_does_not_know_its_limits_or_lacks_the_button) {
  struct Unknowing final : Pushing {
    Capabilities capabilities() const noexcept override { return known; }
    Capabilities known = Pushing::capabilities();
  } none, low;
  none.known.friction = std::nanf("");
  low.known.workspace_low.z() = std::nanf("");
  for (Unknowing* device : {&none, &low})
    EXPECT_THROW(run_servo_loop(*device, wall(), unpaced(), kNeverStop), std::invalid_argument);
  Pushing device;
  Unknowing bare;
  bare.known.buttons = 0;
  const auto words = [](Device& its, int button) {
    return tests::thrown_by<std::invalid_argument>(
        [&] { run_servo_loop(its, wall(), {.dead_man_button = button}, kNeverStop); });
  };
  for (const int button : {-1, 2})
    EXPECT_EQ(words(device, button), "dead-man button: expected 0 to 1, a button of the device, got " + std::to_string(button));
  EXPECT_EQ(words(bare, 0), "dead-man button: expected none, because the device has no buttons, got 0");
  EXPECT_TRUE(device.commands.empty() && none.commands.empty() && bare.commands.empty());
}

}  // namespace
}  // namespace forceshade::device
