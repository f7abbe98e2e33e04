// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is expected of every device whose frames a thread of ours makes.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "forceshade/servo_loop.h"
#include "system/system.h"
#include "tests/device/patient.h"
#include "tests/support/allocations.h"

namespace forceshade::device {

// Waits for the next frame.
inline void wait_for_frame(Device& device) {
  device.wait_for_frame(system::now() + std::chrono::nanoseconds(kLongest).count());
}

// What its next reading without a position says.
inline Fault fault_of(Device& device) {
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
    const ReadResult last = device.read();
    if (const auto* fault = std::get_if<Fault>(&last)) return *fault;
  }
}

// Drives it with a force until there is a fault, whose words these are, or those of what did not start.
inline std::string driven(Device& device, double rate) {
  if (const auto fault = device.start(rate)) return fault->words;
  for (;;) {
    wait_for_frame(device);
    const ReadResult reading = device.read();
    if (const auto* fault = std::get_if<Fault>(&reading)) return fault->words;
    device.allow({.work = 1e6, .longest_step = 1});
    device.command({0, 0, 0.5F});
  }
}

// Ticks of a device that runs. Only the thread that calls the device is counted.
inline void expect_ticks_without_allocation(Device& device) {
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 200; ++tick) {
    wait_for_frame(device);
    ASSERT_TRUE(std::holds_alternative<Reading>(device.read()));
    device.allow({.work = 1, .longest_step = 1});
    device.command({0, 0, 0.1F});
  }
  device.command({0, 0, 0});
  EXPECT_EQ(tests::allocations(), before);
}

// A force far beyond its highest is shortened, and one that is not finite is refused.
inline void command_too_much(Device& device) {
  ASSERT_FALSE(device.start(1000));
  device.allow({.work = 1e6, .longest_step = 1});
  for (int tick = 0; tick < 50; ++tick) {
    wait_for_frame(device);
    device.read();
    EXPECT_FALSE(device.command({0, 0, 100}));
  }
  EXPECT_TRUE(device.command({0, 0, std::numeric_limits<float>::quiet_NaN()}));
}

// verdict: of a stand-in, whose client commanded too much of a device whose highest force is that.
inline void expect_highest_force(const nlohmann::json& verdict, double highest) {
  EXPECT_EQ(verdict["faults"], nlohmann::json::object());
  const double largest = verdict["sessions"][0]["largest_force_N"];
  EXPECT_LE(largest, highest);
  EXPECT_GT(largest, highest - 0.1);
  EXPECT_EQ(verdict["sessions"][0]["force_at_end_N"], 0);
}

// As many as the environment's variable says.
inline int frames_named_by(const char* variable) {
  const char* said = std::getenv(variable);
  return said ? std::atoi(said) : 6000;
}

// What goes wrong in a session of the campaign below, as a stand-in's events: "late@5300".
using Events = std::vector<std::string>;

// How a session ended, the stand-in's verdict, and how many frames it answered.
struct Session {
  ServoResult run;
  nlohmann::json verdict;
  int frames;
};

// What goes wrong in contact, and the words that end the run for it.
struct Wrong {
  const char *event, *words;
};

// Ten times as fast as real time. Lasts for so many frames at most.
inline ServoOptions fast_loop(int frames) {
  constexpr double kRate = 10'000;
  return {.rate_hz = kRate, .max_seconds = frames / kRate, .watchdog_timeout = 10};
}

// A campaign over a stand-in, which finds no fault: so many frames in sessions, the first of which ends when its time is up,
// and each other one by the next of `endings`. All endings where there are at least 6000 frames for each. What a session
// survives, `passing`, happens over and over in each. `session` makes one of so many frames.
inline void expect_no_blame(int frames, const Events& passing, const Events& endings,
                            const std::function<Session(const Events&, int)>& session) {
  constexpr int kToBeReady = 5000, kApart = 7000;  // frames: without force at the beginning, and between two events
  const std::size_t count = 1 + std::min(endings.size(), static_cast<std::size_t>(frames / 6000));
  const int each = frames / static_cast<int>(count);
  std::size_t ticks = 0;
  double peak = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Events events;
    for (std::size_t j = 0; j < 12 && static_cast<int>(j) * kApart < each; ++j)
      events.push_back(passing[j % passing.size()] + '@' + std::to_string(kToBeReady + 300 + static_cast<int>(j) * kApart));
    if (i > 0) events.push_back(endings[i - 1] + '@' + std::to_string(kToBeReady + each));
    const auto& [run, verdict, answered] = session(events, i == 0 ? each : 2 * each);
    std::printf("%s: %zu ticks, %s %s; peak %.3f N; %s\n", i == 0 ? "in order" : endings[i - 1].c_str(), run.ticks,
                name_of(run.end_reason).data(), run.fault, run.peak_force_N, verdict["sessions"].dump().c_str());
    EXPECT_EQ(verdict["faults"], nlohmann::json::object()) << events.back();
    if (i == 0) {
      EXPECT_EQ(run.end_reason, EndReason::time_up) << run.fault;
    } else {
      EXPECT_TRUE(run.end_reason == EndReason::device_fault || run.end_reason == EndReason::tripped) << events.back();
      EXPECT_GE(answered, kToBeReady + each - 1) << "ended before " << events.back();
    }
    ticks += run.ticks;
    peak = std::max(peak, run.peak_force_N);
  }
  std::printf("%zu ticks in %zu sessions, at most %.3f N\n", ticks, count, peak);
  if (each > 12'000) {
    EXPECT_GT(peak, 0.1);  // by then the hand is in contact
  }
}

}  // namespace forceshade::device
