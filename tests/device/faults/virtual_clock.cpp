// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/faults/virtual_clock.h"

#include <time.h>

#include <cerrno>
#include <utility>

namespace {
thread_local forceshade::faults::VirtualClock* current = nullptr;
constexpr std::int64_t kSecond = 1'000'000'000;
}  // namespace

extern "C" {
int __real_clock_gettime(clockid_t clock, timespec* time);
int __real_clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left);

int __wrap_clock_gettime(clockid_t clock, timespec* time) {
  if (!current || (clock != CLOCK_MONOTONIC && clock != CLOCK_THREAD_CPUTIME_ID)) return __real_clock_gettime(clock, time);
  const std::int64_t now = clock == CLOCK_MONOTONIC ? current->now() : current->processor_time();
  *time = {.tv_sec = now / kSecond, .tv_nsec = now % kSecond};
  return 0;
}

int __wrap_clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  if (!current) return __real_clock_nanosleep(clock, flags, time, left);
  if (current->is_interrupted()) return EINTR;
  current->sleep_until(time->tv_sec * kSecond + time->tv_nsec);
  return 0;
}
}

namespace forceshade::faults {

VirtualClock::VirtualClock() : outer_(std::exchange(current, this)) {}

VirtualClock::~VirtualClock() {
  current = outer_;
}

}  // namespace forceshade::faults
