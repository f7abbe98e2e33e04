// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the system grants a thread that must not be late.

#include <sched.h>

#include <optional>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

// Takes them for as long as it lives, as far as the system allows, and gives them back.
class RealTime {
 public:
  // Above the interrupt threads of a real-time kernel (50), below its watchdogs (99).
  static constexpr int kPriority = 80;
  // A device's frames come before the servo loop: each takes some µs, and one that is late holds an old force.
  static constexpr int kFramesPriority = kPriority + 5;

  // Pins to this processor; without one, to the last that the thread may run on, since the first serves most interrupts.
  explicit RealTime(std::optional<int> cpu, int priority = kPriority) noexcept;
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  const Privileges& granted() const noexcept { return granted_; }

 private:
  int old_policy_ = SCHED_OTHER;
  sched_param old_parameters_{};
  cpu_set_t old_cpus_{};
  Privileges granted_;
};

// For a device's frames: another processor than the servo loop's, which is the last, where there are two.
std::optional<int> processor_before_last() noexcept;

}  // namespace forceshade::device
