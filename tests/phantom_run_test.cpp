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
#include "forceshade/device/hdapi_words.h"
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
  EXPECT_TRUE(reading.joints);
  EXPECT_TRUE(device.state().calibrated);
  EXPECT_TRUE(device.state().forces_on);
  EXPECT_EQ(device.state().temperature, 0.25F);
  device.command({0.25F, 0.5F, 1});
  EXPECT_TRUE(comes_true([] { return last_force() == Eigen::Vector3d(0.25, 1, -0.5); }));
  EXPECT_TRUE(comes_true([&] {
    const auto sent = std::get<Reading>(device.read()).sent;
    EXPECT_TRUE(sent);
    return sent && sent->acting == Eigen::Vector3f(0.25F, 0.5F, 1) && sent->acted == sent->acting;
  }));
}

// One run: what was commanded too early, the clock, and the two ends of what may be commanded.
TEST_F(phantom, obeys_what_is_commanded_after_the_start_within_its_highest_force_and_while_it_is_finite) {
  Phantom device("", kPatient);
  device.command({0, 0, 1});
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
  for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0)) << "commanded before the start";

  device.command({30, 0, 40});
  const Eigen::Vector3d shortened = 0.95 * Eigen::Vector3d(5.1, 6.8, 0);
  EXPECT_TRUE(comes_true([&] { return (last_force() - shortened).norm() <= 1e-6; }));

  for (const float wrong : {std::nanf(""), HUGE_VALF}) {
    device.command({0, 0, 1});
    EXPECT_TRUE(comes_true([] { return last_force() == Eigen::Vector3d(0, 1, 0); }));
    EXPECT_STREQ(device.command({0, wrong, 0})->words, "a force that is not finite was commanded");
    EXPECT_TRUE(comes_true([] { return last_force().isZero(0); }));
  }
}

TEST_F(phantom, force_is_not_held_when_the_loop_stalls_and_zero_may_be_held_for_ever) {
  Phantom device("", {.patience = 200ms, .start = 20s, .rate_tolerance = 1});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 0});
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(seen().output);
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

TEST_F(phantom, is_lost_when_the_driver_runs_no_frames) {
  Phantom device("", {.patience = 200ms, .start = 20s, .rate_tolerance = 1});
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
  tell({.instantaneous_rate = 1000, .frame_time = 20ms});
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

// Those that only a frame can see are tried in phantom_frames_test; here, the way from a frame to the user's words.
TEST_F(phantom, trouble_while_it_runs_ends_it_in_words_and_without_force) {
  const std::vector<Failure> failures{
      {{.end = {hdapi::kWarmMotors}}, {"ending a frame", "the motors are too warm", "0x0200", "cool"}},
      {{.end = {hdapi::kDeviceFault, hdapi::kFrame, hdapi::kForceError}}, {"0x0300", "power"}},  // the first of several
      {{.end = {0x9999}}, {"0x9999", "vendor's reference"}},
      {{.withholds_position = true}, {"not finite"}},
      {{.position = Eigen::Vector3d(0, -110, -35)}, {"uncalibrated"}},
      {{.temperature = std::nan("")}, {"motor temperatures that are no numbers"}},
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

// The driver reports it once; the position stands still from then on. Every later attempt says so again, also where the driver
// has reported it to somebody else before.
TEST_F(phantom, lost_connection_ends_the_run_and_is_said_again_by_the_next) {
  {
    Phantom device("", kPatient);
    ASSERT_FALSE(device.start(1000));
    device.command({0, 0, 1});
    ASSERT_TRUE(comes_true([] { return !last_force().isZero(0); }));
    tell({.comm_lost = true});
    expect_words(fault_of(device), {"communication with the device failed", "0x0302", "Ethernet"});
  }
  for (const Orders& orders : {Orders{.comm_lost = true}, Orders{.instantaneous_rate = 0}}) {
    tell(orders);
    Phantom again("", {.patience = 2s, .start = 1s, .rate_tolerance = 1});
    const auto fault = again.start(1000);
    ASSERT_TRUE(fault);
    expect_words(fault->words, {"check cable and power"});
    EXPECT_TRUE(last_force().isZero(0));
    EXPECT_FALSE(seen().output);
  }
}

// Nothing is reported: only the driver's count of its frames tells.
TEST_F(phantom, connection_that_is_lost_without_an_error_ends_the_run) {
  Phantom device("", kPatient);
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 1});
  ASSERT_TRUE(comes_true([] { return !last_force().isZero(0); }));
  tell({.instantaneous_rate = 0});
  EXPECT_EQ(fault_of(device), hdapi::kNoAnswer);
  EXPECT_TRUE(comes_true([] { return last_force().isZero(0) && !seen().output; }));
}

TEST_F(phantom, words_of_a_fault_outlive_the_device) {
  std::vector<const char*> words;
  for (const hdapi::HDerror code : {hdapi::kSchedulerFull, hdapi::kDeviceFault}) {
    tell({.schedule = code});
    Phantom device("", kPatient);
    words.push_back(device.start(1000)->words);
  }
  expect_words(words[0], {"0x0501"});
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

// The hand presses into the wall when the calibration is lost: the supervisor's answer.
TEST_F(phantom, that_loses_its_calibration_under_force_trips) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  constexpr std::uint64_t kLost = 1800;  // frame: some 1.3 s after the output went on, with the hand down
  tell({.calibration = std::nullopt,
        .in_inkwell = true,
        .calibration_lost_at = kLost,
        .instantaneous_rate = 1000,
        .press = true});
  ServoResult result;
  {
    Phantom device("", kPatient);
    result = run_servo_loop(device, law, {.max_seconds = 20, .patience = 10}, std::atomic<bool>(false));
  }
  EXPECT_EQ(result.end_reason, EndReason::tripped) << result.fault;
  ASSERT_TRUE(result.trip);
  EXPECT_EQ(result.trip->rule, Rule::uncalibrated);
  const auto frames = seen().frames;
  ASSERT_GT(frames.size(), kLost);
  EXPECT_GT(frames[kLost - 10].force.norm(), 0.2);
  EXPECT_TRUE(frames.back().force.isZero(0));
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
  EXPECT_TRUE(result.followed_device);
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
