// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gives a window the latest tick of a servo loop in another thread, and ends that loop on demand.

#include <atomic>
#include <optional>

#include "device/triple_buffer.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

class LatestTick final : public SampleSink {
 public:
  // asked: set by a signal, for instance; it sets `stop` at the next tick, whatever the thread of the window does. Both live
  // longer.
  LatestTick(const std::atomic<bool>& asked, std::atomic<bool>& stop) : asked_(asked), stop_(stop) {}

  void push(const Sample& sample) noexcept override {
    mailbox_.publish({sample, true});
    if (asked_) stop_ = true;
  }

  // For one reading thread; nothing before the first tick.
  std::optional<Sample> latest() {
    const Tick& tick = mailbox_.latest();
    return tick.is_there ? std::optional(tick.sample) : std::nullopt;
  }

 private:
  struct Tick {
    Sample sample;
    bool is_there = false;
  };
  const std::atomic<bool>& asked_;
  std::atomic<bool>& stop_;
  TripleBuffer<Tick> mailbox_;
};

}  // namespace forceshade::device
