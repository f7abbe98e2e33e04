// SPDX-License-Identifier: BSD-3-Clause
// A PHANToM that runs: what it gives, what it obeys, and how it ends. Its frames, one by one, are those of phantom_frames_test;
// stalls, and frames that end, are those of phantom_world_test.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "device/phantom/hdapi_words.h"
#include "system/system.h"
#include "tests/world/phantom_fixture.h"

namespace forceshade::world {
namespace {

IN_WORLD(speaks_in_the_laws_frame) {
  tell({.position = Eigen::Vector3d(1, 2, 3)});
  Phantom device = opened(kPatient);
  ASSERT_FALSE(device.start(1000));
  const auto reading = std::get<Reading>(device.read());
  EXPECT_EQ(reading.position, Eigen::Vector3f(1, -3, 2));
  EXPECT_EQ(reading.buttons & 1U, 1U);
  EXPECT_EQ(reading.gimbal, Eigen::Vector3f(0.1F, 0.2F, 0.3F));
  EXPECT_TRUE(reading.encoder);
  EXPECT_TRUE(reading.joints);
  EXPECT_TRUE(device.state().calibrated);
  EXPECT_TRUE(device.state().forces_on);
  EXPECT_EQ(device.state().temperature, 0.25F);
  device.command({0.25F, 0.5F, 1});
  wait_until([] { return last_force() == Eigen::Vector3d(0.25, 1, -0.5); });
  wait_until([&] {
    const auto sent = std::get<Reading>(device.read()).sent;
    EXPECT_TRUE(sent);
    return sent && sent->acting == Eigen::Vector3f(0.25F, 0.5F, 1) && sent->acted == sent->acting;
  });
}

// One run: what was commanded too early, the clock, and the two ends of what may be commanded.
IN_WORLD(obeys_what_is_commanded_after_the_start_within_its_highest_force_and_while_it_is_finite) {
  Phantom device = opened(kPatient);
  device.command({0, 0, 1});
  const std::int64_t before = system::now();
  ASSERT_FALSE(device.start(1000));
  double last = std::get<Reading>(device.read()).time;
  EXPECT_GE(last, 0);
  EXPECT_LE(last, static_cast<double>(system::now() - before) * 1e-9) << "counted from the start";
  const double first = last;
  wait_until([&] {
    const double time = std::get<Reading>(device.read()).time;
    EXPECT_GE(time, last);
    last = time;
    return time >= first + 0.05;
  });
  for (const auto& frame : seen().frames) EXPECT_TRUE(frame.force.isZero(0)) << "commanded before the start";

  device.command({30, 0, 40});
  const Eigen::Vector3d shortened = 0.95 * Eigen::Vector3d(5.1, 6.8, 0);
  wait_until([&] { return (last_force() - shortened).norm() <= 1e-6; });

  for (const float wrong : {std::nanf(""), HUGE_VALF}) {
    device.command({0, 0, 1});
    wait_until([] { return last_force() == Eigen::Vector3d(0, 1, 0); });
    EXPECT_STREQ(device.command({0, wrong, 0})->words, "a force that is not finite was commanded");
    wait_until([] { return last_force().isZero(0); });
  }
}

// The way from a frame to the user's words; that of one which has lasted is in the next run's.
IN_WORLD(trouble_while_it_runs_ends_it_in_words_and_without_force) {
  struct Failure {
    Orders orders;
    std::vector<std::string> words;
  };
  for (const auto& [orders, words] :
       {Failure{{.end = {hdapi::kWarmMotors}}, {"ending a frame", "the motors are too warm", "0x0200", "cool"}},
        Failure{{.end = {hdapi::kDeviceFault, hdapi::kFrame, hdapi::kForceError}},
                {"0x0300", "power"}},  // the first of several
        Failure{{.end = {0x9999}}, {"0x9999", "vendor's reference"}},
        Failure{{.comm_lost = true}, {"communication with the device failed", "0x0302", "Ethernet"}}}) {
    SCOPED_TRACE(words.front());
    tell({});
    Phantom device = opened(kPatient);
    ASSERT_FALSE(device.start(1000));
    device.command({0, 0, 1});
    wait_until([] { return !last_force().isZero(0); });
    tell(orders);
    expect_words(fault_of(device), words);
    EXPECT_FALSE(device.state().forces_on);
    wait_until([] { return last_force().isZero(0) && !seen().output; });
    // Also when the driver has come to.
    tell({});
    device.command({0, 0, 1});
    const std::size_t frames = seen().frames.size();
    wait_until([&] { return seen().frames.size() >= frames + 3; });
    EXPECT_TRUE(last_force().isZero(0));
    expect_words(fault_of(device), words);
  }
  tell({.comm_lost = true});
  Phantom again = opened(kPatient);
  const auto fault = again.start(1000);
  ASSERT_TRUE(fault);
  expect_words(fault->words, {"check cable and power"});
  EXPECT_FALSE(seen().output);
}

IN_WORLD(words_of_a_fault_outlive_the_device) {
  std::vector<const char*> words;
  for (const hdapi::HDerror code : {hdapi::kSchedulerFull, hdapi::kDeviceFault}) {
    tell({.schedule = code});
    Phantom device = opened(kPatient);
    words.push_back(device.start(1000)->words);
  }
  expect_words(words[0], {"0x0501"});
  expect_words(words[1], {"0x0300"});
}

// Keeps the loop waiting between its two calls, so that a frame begins there.
IN_WORLD(frame_that_began_between_waiting_and_reading_is_not_read_again) {
  Phantom device = opened(kPatient);
  ASSERT_FALSE(device.start(1000));
  double last = -1;
  for (int tick = 0; tick < 20; ++tick) {
    device.wait_for_frame(system::now() + 600 * system::kSecond);
    if (tick % 2 == 0) system::sleep_for(5ms);
    const double time = std::get<Reading>(device.read()).time;
    EXPECT_GT(time, last);
    last = time;
  }
}

}  // namespace
}  // namespace forceshade::world
