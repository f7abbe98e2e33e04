// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One line in the terminal that follows a run: time, rate, jitter, force, energy account, what the supervisor does.

#include <atomic>
#include <cstdint>

#include "device/triple_buffer.h"
#include "forceshade/servo_loop.h"
#include "system/system.h"

namespace forceshade::apps {

// Draws on standard error ten times a second, from a thread of its own, while it lives. The servo loop only leaves its latest
// tick in a mailbox.
class LiveView final : public device::SampleSink {
 public:
  // full_force: N, where the bar ends.
  explicit LiveView(double full_force);
  ~LiveView() override;

  void push(const device::Sample& sample) noexcept override;

 private:
  struct Shown {
    device::Sample last;
    std::int64_t worst_wakeup = 0;  // ns, over about the time of one drawing
    std::uint16_t limited = 0;      // rules, over the same time
  };

  void follow();
  void draw(const Shown& before, const Shown& now) const;

  double full_force_;
  Shown shown_;                    // the servo loop's
  std::int64_t window_start_ = 0;  // ns
  device::TripleBuffer<Shown> mailbox_;
  std::atomic<bool> stopping_ = false;
  system::Thread thread_;
};

}  // namespace forceshade::apps
