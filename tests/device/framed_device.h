// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is expected of every device whose frames a thread of ours makes.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <variant>

#include "device/monotonic.h"
#include "forceshade/servo_loop.h"
#include "tests/support/allocations.h"

namespace forceshade::device {

// What its next reading without a position says; "none" where that does not come.
inline Fault fault_of(Device& device) {
  ReadResult last = device.read();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!std::holds_alternative<Fault>(last) && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    last = device.read();
  }
  return std::holds_alternative<Fault>(last) ? std::get<Fault>(last) : Fault{"none"};
}

// Ticks of a device that runs. Only the thread that calls the device is counted.
inline void expect_ticks_without_allocation(Device& device) {
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 200; ++tick) {
    device.wait_for_frame(monotonic_now() + 20 * kSecond);
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
    device.wait_for_frame(monotonic_now() + 20 * kSecond);
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

// Ten times as fast as real time.
inline ServoOptions fast_loop(int frames) {
  constexpr double kRate = 10'000;
  return {.rate_hz = kRate, .max_seconds = frames / kRate, .watchdog_timeout = 1};
}

// After such a loop over a stand-in, which finds no fault.
inline void expect_no_blame(const ServoResult& run, const nlohmann::json& verdict, int frames) {
  std::printf("%zu ticks, %s; peak %.3f N; %s\n", run.ticks, name_of(run.end_reason).data(), run.peak_force_N,
              verdict["sessions"].dump().c_str());
  EXPECT_EQ(run.end_reason, EndReason::time_up) << (run.fault ? run.fault : "");
  EXPECT_EQ(verdict["faults"], nlohmann::json::object());
  if (frames > 12'000) {
    EXPECT_GT(run.peak_force_N, 0.1);  // by then the hand is in contact
  }
}

}  // namespace forceshade::device
