// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The latest value from one thread for one other: whole, never torn, and neither ever waits.

#include <array>
#include <atomic>
#include <cstdint>

#include "system/system.h"

namespace forceshade::device {

// A triple buffer. Of three slots the writer owns one, the reader one, and the third changes hands; not a lock and not a
// sequence lock, since a writer that is preempted would make a real-time reader wait or repeat.
template <class T>
class TripleBuffer {
 public:
  // Called by the writing thread.
  void publish(const T& value) noexcept {
    system::step();
    slots_[writers_] = value;
    system::step();
    writers_ = shared_.exchange(writers_ | kFresh, std::memory_order_acq_rel) & kSlot;
  }

  // Called by the reading thread; the result is valid until its next call. T{} before anything was published.
  const T& latest() noexcept {
    system::step();
    if (shared_.load(std::memory_order_relaxed) & kFresh)
      readers_ = shared_.exchange(readers_, std::memory_order_acq_rel) & kSlot;
    return slots_[readers_];
  }

 private:
  static constexpr unsigned kSlot = 3, kFresh = 4;
  static_assert(std::atomic<unsigned>::is_always_lock_free);

  std::array<T, 3> slots_{};
  unsigned writers_ = 0, readers_ = 1;
  std::atomic<unsigned> shared_ = 2;
};

}  // namespace forceshade::device
