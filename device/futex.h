// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waiting for a number that another process changes, in memory that both map.

#include <linux/futex.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

#include "device/monotonic.h"

namespace forceshade::device {

// Until the number is another than `seen`, a signal comes, or it is `deadline` (monotonic_now()).
inline void wait_for_change(const std::atomic<std::uint32_t>& number, std::uint32_t seen, std::int64_t deadline) noexcept {
  const timespec until{.tv_sec = deadline / kSecond, .tv_nsec = deadline % kSecond};
  syscall(SYS_futex, &number, FUTEX_WAIT_BITSET, seen, &until, nullptr, FUTEX_BITSET_MATCH_ANY);
}

// Whoever waits for it.
inline void wake(const std::atomic<std::uint32_t>& number) noexcept {
  syscall(SYS_futex, &number, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

}  // namespace forceshade::device
