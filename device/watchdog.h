// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Notices from another thread that the servo loop stalled, so that someone else can command zero.

#include <atomic>
#include <cstdint>
#include <limits>

namespace forceshade::device {

// Times are of one steady clock, in ns. Fed once a tick by the loop and checked by one or more other threads; neither waits.
class Watchdog {
 public:
  Watchdog(std::int64_t patience, std::int64_t now) noexcept : patience_(patience), fed_(now) {}

  // False once it has barked, and from then on: the loop then commands zero and nothing else.
  [[nodiscard]] bool feed(std::int64_t now) noexcept {
    std::int64_t before = fed_.load(std::memory_order_relaxed);
    // In one atomic with the bark: a loop that wakes while it is checked is either in time or told.
    while (before != kBarked && !fed_.compare_exchange_weak(before, now)) {
    }
    return before != kBarked;
  }

  // True once it was not fed for longer than its patience, and from then on.
  [[nodiscard]] bool barked(std::int64_t now) noexcept {
    std::int64_t before = fed_.load();
    while (before != kBarked && now - before > patience_) {
      if (fed_.compare_exchange_weak(before, kBarked)) return true;
    }
    return before == kBarked;
  }

 private:
  static constexpr std::int64_t kBarked = std::numeric_limits<std::int64_t>::min();
  static_assert(std::atomic<std::int64_t>::is_always_lock_free, "the loop waits for nobody");

  std::int64_t patience_;
  std::atomic<std::int64_t> fed_;
};

}  // namespace forceshade::device
