// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM that runs: what it gives, what it obeys, and how it ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "forceshade/device/arm.h"
#include "forceshade/device/servo_loop.h"
#include "forceshade/tests/kept_samples.h"
#include "forceshade/tests/stand_in_hd/phantom_fixture.h"

namespace forceshade::device {
namespace {

Eigen::Vector3d last_force() {
  const auto frames = seen().frames;
  return frames.empty() ? Eigen::Vector3d(0, 0, 0) : frames.back().force;
}

std::string fault_of(Phantom& phantom) {
  std::string words;
  comes_true([&] {
    const ReadResult read = phantom.read();
    if (const Fault* fault = std::get_if<Fault>(&read)) words = fault->words;
    return !words.empty();
  });
  return words;
}

TEST_F(phantom, speaks_in_the_laws_frame) {
  tell({.position = Eigen::Vector3d(1, 2, 3)});
  Phantom device("", kPatient);
  ASSERT_FALSE(device.start(1000));
  const auto reading = std::get<Reading>(device.read());
  EXPECT_EQ(reading.position, Eigen::Vector3f(1, -3, 2));
  EXPECT_EQ(reading.buttons, 2U);
  EXPECT_EQ(reading.gimbal, Eigen::Vector3f(0.1F, 0.2F, 0.3F));
  EXPECT_TRUE(reading.encoder);
  EXPECT_TRUE(device.state().calibrated);
  EXPECT_TRUE(device.state().forces_on);
  EXPECT_EQ(device.state().temperature, 0.25F);
  device.command({0.25F, 0.5F, 1});
  EXPECT_TRUE(comes_true([] { return last_force() == Eigen::Vector3d(0.25, 1, -0.5); }));
}

TEST_F(phantom, force_commanded_before_the_start_is_not_remembered) {
  Phantom device("", kPatient);
  device.command({0, 0, 1});
  ASSERT_FALSE(device.start(1000));
  const std::size_t frames = seen().frames.size();
  EXPECT_TRUE(comes_true([&] { return seen().frames.size() >= frames + 5; }));
  for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0));
}

TEST_F(phantom, clock_goes_with_the_frames) {
  Phantom device("", kPatient);
  const auto before = Clock::now();
  ASSERT_FALSE(device.start(1000));
  double last = std::get<Reading>(device.read()).time;
  EXPECT_GE(last, 0);
  EXPECT_LE(last, std::chrono::duration<double>(Clock::now() - before).count()) << "counted from the start";
  const double first = last;
  EXPECT_TRUE(comes_true([&] {
    const double time = std::get<Reading>(device.read()).time;
    EXPECT_GE(time, last);
    last = time;
    return time >= first + 0.05;
  }));
}

TEST_F(phantom, force_is_shortened_to_the_highest_and_keeps_its_direction) {
  Phantom device("", kPatient);
  ASSERT_FALSE(device.start(1000));
  device.command({30, 0, 40});
  EXPECT_TRUE(comes_true([] { return (last_force() - Eigen::Vector3d(5.1, 6.8, 0)).norm() <= 1e-6; }));
}

TEST_F(phantom, force_that_is_not_finite_is_refused_and_none_is_held) {
  Phantom device("", kPatient);
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 1});
  EXPECT_TRUE(comes_true([] { return !last_force().isZero(0); }));
  for (const float wrong : {std::nanf(""), HUGE_VALF})
    EXPECT_STREQ(device.command({0, wrong, 0})->words, "a force that is not finite was commanded");
  EXPECT_TRUE(comes_true([] { return last_force().isZero(0); }));
}

TEST_F(phantom, force_is_not_held_when_the_loop_stalls) {
  Phantom device("", {.patience = 200ms, .start = 20s});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 1});
  EXPECT_TRUE(comes_true([] { return !last_force().isZero(0); }));
  EXPECT_TRUE(comes_true([] { return last_force().isZero(0) && !seen().output; }));
  EXPECT_EQ(fault_of(device), hdapi::kStalled);
  // It does not come back with a kick.
  device.command({0, 0, 1});
  const std::size_t frames = seen().frames.size();
  EXPECT_TRUE(comes_true([&] { return seen().frames.size() >= frames + 5; }));
  EXPECT_TRUE(last_force().isZero(0));
  EXPECT_FALSE(device.state().forces_on);
}

TEST_F(phantom, zero_may_be_held_for_ever) {
  Phantom device("", {.patience = 200ms, .start = 20s});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 0});
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(seen().output);
}

TEST_F(phantom, is_lost_when_the_driver_runs_no_frames) {
  Phantom device("", {.patience = 200ms, .start = 20s});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 1});
  EXPECT_TRUE(comes_true([] { return !last_force().isZero(0); }));
  tell({.hung = true});
  EXPECT_EQ(fault_of(device), hdapi::kSilent);
  tell({});
  EXPECT_TRUE(comes_true([] { return last_force().isZero(0); }));
}

TEST_F(phantom, slow_frames_within_patience_are_no_fault) {
  Phantom device("", kPatient);
  ASSERT_FALSE(device.start(1000));
  tell({.frame_time = 20ms});
  const std::size_t frames = seen().frames.size();
  EXPECT_TRUE(comes_true([&] {
    EXPECT_TRUE(std::holds_alternative<Reading>(device.read()));
    return seen().frames.size() >= frames + 5;
  }));
}

struct Failure {
  Orders orders;
  std::vector<std::string> words;
};

TEST_F(phantom, trouble_while_it_runs_ends_it_in_words_and_without_force) {
  const std::vector<Failure> failures{
      {{.begin = hdapi::kCommunication}, {"beginning a frame", "communication with the device failed", "0x0302", "Ethernet"}},
      {{.end = {hdapi::kWarmMotors}}, {"ending a frame", "the motors are too warm", "0x0200", "cool"}},
      {{.end = {hdapi::kExceededForce}}, {"the highest force was exceeded", "0x0201", "recover"}},
      {{.end = {hdapi::kExceededImpulse}}, {"the highest change of force was exceeded", "0x0202"}},
      {{.end = {hdapi::kExceededVelocity}}, {"the highest velocity was exceeded", "0x0203"}},
      {{.set = hdapi::kForceError}, {"setting the force", "the force could not be sent", "0x0204"}},
      {{.end = {hdapi::kDeviceFault}}, {"the device reports a fault", "0x0300", "power"}},
      {{.end = {hdapi::kDeviceFault, hdapi::kFrame, hdapi::kForceError}}, {"0x0300"}},  // the first of several
      {{.end = {0x9999}}, {"0x9999", "vendor's reference"}},
      {{.get_position = hdapi::kCommunication}, {"reading the position", "0x0302"}},
      {{.position = Eigen::Vector3d(std::nan(""), 0, 0)}, {"not finite"}},
      {{.withholds_position = true}, {"not finite"}},
      {{.position = Eigen::Vector3d(0, -110, -35)}, {"uncalibrated"}},
  };
  for (const Failure& failure : failures) {
    SCOPED_TRACE(failure.words.front());
    tell({});
    Phantom device("", kPatient);
    ASSERT_FALSE(device.start(1000));
    device.command({0, 0, 1});
    ASSERT_TRUE(comes_true([] { return !last_force().isZero(0); }));
    tell(failure.orders);
    expect_words(fault_of(device), failure.words);
    EXPECT_FALSE(device.state().forces_on);
    EXPECT_TRUE(comes_true([] { return last_force().isZero(0) && !seen().output; }));
    // Also when the driver has come to.
    tell({});
    device.command({0, 0, 1});
    const std::size_t frames = seen().frames.size();
    EXPECT_TRUE(comes_true([&] { return seen().frames.size() >= frames + 3; }));
    EXPECT_TRUE(last_force().isZero(0));
    expect_words(fault_of(device), failure.words);
  }
}

TEST_F(phantom, words_of_a_fault_outlive_the_device) {
  std::vector<const char*> words;
  for (const hdapi::HDerror code : {hdapi::kTimer, hdapi::kDeviceFault}) {
    tell({.start = code});
    Phantom device("", kPatient);
    words.push_back(device.start(1000)->words);
  }
  expect_words(words[0], {"0x0304"});
  expect_words(words[1], {"0x0300"});
}

// Closed in the middle of a push: TearDown and the stand-in want zero sent, then the output off, then the scheduler stopped.
TEST_F(phantom, closed_under_force_sends_zero_first) {
  {
    Phantom device("", kPatient);
    ASSERT_FALSE(device.start(1000));
    device.command({0, 0, 1});
    EXPECT_TRUE(comes_true([] { return !last_force().isZero(0); }));
  }
  EXPECT_TRUE(last_force().isZero(0));
}

TEST_F(phantom, closed_while_the_driver_hangs_is_off_in_bounded_time) {
  auto device = std::make_unique<Phantom>("", kPatient);
  ASSERT_FALSE(device->start(1000));
  tell({.hung = true});
  const auto before = Clock::now();
  device.reset();
  EXPECT_LE(Clock::now() - before, 5s);
  EXPECT_FALSE(seen().output);
}

// Every force sent is one that the loop commanded, whole, and answers a position that a frame before it gave.
TEST_F(phantom, servo_loop_pushes_a_hand_out_of_a_wall) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  const std::atomic<bool> never = false;
  tests::KeptSamples kept;
  ServoResult result;
  {
    Phantom device("", kPatient);
    result = run_servo_loop(device, law, {.max_seconds = 2.0, .patience = 10, .sinks = {&kept}}, never);
  }
  EXPECT_EQ(result.end_reason, EndReason::time_up) << result.fault;
  EXPECT_TRUE(result.supervised);
  EXPECT_GE(result.peak_force_N, 0.1);

  std::set<std::pair<std::array<float, 3>, std::array<float, 3>>> commanded;
  for (const Sample& sample : kept.samples) commanded.emplace(sample.position, sample.force);
  const auto array = [](const Eigen::Vector3d& v) {
    const Eigen::Vector3f in_law = turned_to_law(v).cast<float>();
    return std::array{in_law.x(), in_law.y(), in_law.z()};
  };
  const auto frames = seen().frames;
  std::vector<std::size_t> lags;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (frames[k].force.isZero(0)) continue;
    const auto answers = [&](std::size_t lag) {
      return commanded.contains({array(frames[k - lag].position), array(frames[k].force)});
    };
    std::size_t lag = 1;
    while (lag < k && !answers(lag)) ++lag;
    ASSERT_LT(lag, k) << "frame " << k << " sent a force that no position explains";
    lags.push_back(lag);
  }
  ASSERT_GE(lags.size(), 100U);
  std::sort(lags.begin(), lags.end());
  std::printf(
      "  %zu frames, %zu with force, up to %.2f N; a force is sent %zu frames after its position (median), %zu (99 %%)\n",
      frames.size(), lags.size(), result.peak_force_N, lags[lags.size() / 2], lags[lags.size() * 99 / 100]);
}

}  // namespace
}  // namespace forceshade::device
