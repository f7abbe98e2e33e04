// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tests of every device whose frames a thread of ours makes.

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
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

// The fault in place of its next reading without a position.
inline Fault fault_of(Device& device) {
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
    const ReadResult last = device.read();
    if (const auto* fault = std::get_if<Fault>(&last)) return *fault;
  }
}

// Drives it with a force until there is a fault; returns its words, or those of a failed start.
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

// It starts, and is driven under force for some ticks.
inline void expect_ticks(Device& device) {
  ASSERT_FALSE(device.start(1000));
  for (int tick = 0; tick < 50; ++tick) {
    wait_for_frame(device);
    ASSERT_TRUE(std::holds_alternative<Reading>(device.read()));
    device.allow({.work = 1e6, .longest_step = 1});
    EXPECT_FALSE(device.command({0, 0, 0.1F}));
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

}  // namespace forceshade::device
