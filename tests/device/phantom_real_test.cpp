// SPDX-License-Identifier: BSD-3-Clause
// What a PHANToM does about time: limits that a machine which is late at the wrong moment reaches, too.

#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "device/phantom/hdapi_words.h"
#include "tests/device/stand_in_hd/phantom_fixture.h"

namespace forceshade::device {
namespace {

Eigen::Vector3d last_force() {
  const auto frames = seen().frames;
  return frames.empty() ? Eigen::Vector3d(0, 0, 0) : frames.back().force;
}

std::string fault_of(Phantom& phantom) {
  std::string words;
  wait_until([&] {
    const ReadResult read = phantom.read();
    if (const Fault* fault = std::get_if<Fault>(&read)) words = fault->words;
    return !words.empty();
  });
  return words;
}

std::string why_not_started(const Orders& orders, const Phantom::Options& options) {
  tell(orders);
  Phantom device("", options);
  const auto fault = device.start(1000);
  return fault ? fault->words : "";
}

TEST_F(phantom, with_slow_frames_or_frames_far_from_the_rate_is_not_started_and_says_what_was_measured) {
  expect_words(why_not_started({.frame_time = 10ms}, {.start = 100ms}), {"runs its frames too slowly"});
  expect_words(why_not_started({.frame_hz = 800}, {.watchdog_timeout = 2s, .start = 1500ms}),
               {"too irregular", "expected 1000 frames a second", "late, longest gap"});
}

TEST_F(phantom, that_does_not_answer_its_driver_is_not_started_though_no_error_is_reported) {
  expect_words(why_not_started({.instantaneous_rate = 0}, {.watchdog_timeout = 2s, .start = 1200ms, .rate_tolerance = 1}),
               {"no longer answers", "check cable and power"});
}

TEST_F(phantom, force_is_not_held_when_the_loop_stalls_and_zero_may_be_held_for_ever) {
  Phantom device("", {.watchdog_timeout = 200ms, .start = 20s, .rate_tolerance = 1});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 0});
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(seen().output);
  device.command({0, 0, 1});
  wait_until([] { return !last_force().isZero(0); });
  wait_until([] { return last_force().isZero(0) && !seen().output; });
  EXPECT_EQ(fault_of(device), hdapi::kStalled);
  // It does not come back with a kick.
  device.command({0, 0, 1});
  const std::size_t frames = seen().frames.size();
  wait_until([&] { return seen().frames.size() >= frames + 5; });
  EXPECT_TRUE(last_force().isZero(0));
  EXPECT_FALSE(device.state().forces_on);
}

TEST_F(phantom, is_lost_when_the_driver_runs_no_frames) {
  Phantom device("", {.watchdog_timeout = 200ms, .start = 20s, .rate_tolerance = 1});
  ASSERT_FALSE(device.start(1000));
  device.command({0, 0, 1});
  wait_until([] { return !last_force().isZero(0); });
  tell({.hung = true});
  EXPECT_EQ(fault_of(device), hdapi::kSilent);
  tell({});
  wait_until([] { return last_force().isZero(0); });
}

}  // namespace
}  // namespace forceshade::device
