// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one clock of all processes: CLOCK_MONOTONIC, in ns.

#include <time.h>

#include <cstdint>

namespace forceshade::device {

inline constexpr std::int64_t kSecond = 1'000'000'000;  // ns

inline std::int64_t monotonic_now() noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace forceshade::device
