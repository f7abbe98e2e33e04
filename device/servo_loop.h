// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs a law on a device at a fixed rate: read a position, command its force, record both.

#include <atomic>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "forceshade/device/device.h"
#include "forceshade/device/record.h"
#include "forceshade/device/sample.h"
#include "forceshade/fast/law.h"

namespace forceshade::device {

inline constexpr double kLowestRateHz = 100;
inline constexpr double kHighestRateHz = 10000;

// The room in the record when neither the device nor `max_seconds` bounds it: ten minutes at 1 kHz.
inline constexpr std::size_t kUnboundedTicks = 600'000;

struct ServoOptions {
  double rate_hz = 1000;  // in [kLowestRateHz, kHighestRateHz]

  // Counted in ticks at that rate; none: until the device ends or someone stops it.
  std::optional<double> max_seconds = std::nullopt;

  // False: each tick follows the last at once, and there are no deadlines to miss.
  bool paced = true;

  // In ticks; none: what device and max_seconds allow.
  std::optional<std::size_t> record_capacity = std::nullopt;

  // Given every tick as it happens, and the zero force that ends the run.
  SampleSink* sink = nullptr;
};

enum class EndReason { end_of_data, time_up, stopped, device_fault, record_full };

std::string_view name_of(EndReason reason) noexcept;

// From position read to force commanded; percentiles by nearest rank, zero if there was no tick.
struct ComputeTime {
  double p50 = 0;
  double p99 = 0;
  double p999 = 0;
  double max = 0;
};

struct ServoResult {
  std::vector<Tick> record;  // every tick, then the zero force that ended the run, at the last position (NaN if there was none)
  EndReason end_reason = EndReason::stopped;
  const char* fault = "";  // the device's words if end_reason is device_fault

  std::size_t ticks = 0;
  std::size_t missed_deadlines = 0;   // ticks whose force was commanded after the next tick was due
  std::size_t invalid_positions = 0;  // ticks where the law refused the position; the force was zero
  double achieved_rate_hz = 0;        // ticks over the time they took
  ComputeTime compute_us;
  double peak_force_N = 0;

  // Work of the force as the device holds it, sum of f(k-1)·(x(k) - x(k-1)): its positive terms are given to the hand, its
  // negative ones, with the sign turned, taken from it. A step from or to a position that is not finite counts for nothing.
  double energy_given_mJ = 0;
  double energy_taken_mJ = 0;

  bool realtime_scheduling = false;  // SCHED_FIFO was granted; asked for only when paced
  bool memory_locked = false;        // mlockall was granted; asked for only when paced
};

// fast::arithmetic_fault() found one: every proof about the fast path would be void.
struct FloatingPointModeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ticks are due at start + k/rate; a late tick is run at once and the schedule kept, so a stall is caught up with.
// `stop` may be set by a signal handler or another thread. However the run ends, the last command is zero force.
// Between the first reading and that command nothing is allocated, locked, written or thrown.
// Before them, throws FloatingPointModeError, or std::invalid_argument for an option out of range.
ServoResult run_servo_loop(Device& device, const fast::Law& law, const ServoOptions& options, const std::atomic<bool>& stop);

}  // namespace forceshade::device
