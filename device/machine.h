// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The settings of a Linux machine that let a servo loop wake in time, each with the line to type where one is lacking
// (docs/real-time-linux.md).

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "device/check.h"
#include "device/quiet_watch.h"

namespace forceshade::device {

struct Machine {
  bool real_time_kernel = false;
  std::uint64_t priority_limit = 0;    // ulimit -r; the largest number where there is no limit
  std::vector<std::string> governors;  // of the processors' clocks, each name once; empty where the system shows none
};

// This machine as it is now; `root` is where /sys is.
Machine this_machine(const std::filesystem::path& root = "/");

// Waking, kernel, scheduling, locked memory and governor. `seen` has how late a loop at `rate` (Hz) woke, and what it was
// granted that asked for real time. No check is graded wrong, since a loop that is never late needs none of these settings.
std::vector<Check> machine_checks(const Machine& machine, const Observed& seen, double rate);

}  // namespace forceshade::device
