// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The clock that the servo loop paces itself by, as a test sets it. While one of these lives, sleeping until an absolute time
// takes none, and nothing else takes any but what pass() and compute() say: a run is late by as much as it is told, on a
// machine under any load. Linked with --wrap=clock_gettime,--wrap=clock_nanosleep; other threads keep the real clock.

#include <algorithm>
#include <cstdint>
#include <utility>

namespace forceshade::faults {

class VirtualClock {
 public:
  VirtualClock();
  ~VirtualClock();
  VirtualClock(const VirtualClock&) = delete;
  VirtualClock& operator=(const VirtualClock&) = delete;

  std::int64_t now() const noexcept { return now_; }  // ns
  void pass(double milliseconds) noexcept { now_ += static_cast<std::int64_t>(milliseconds * 1e6); }
  // The same, by the thread's own work: its processor time passes, too.
  std::int64_t processor_time() const noexcept { return processor_time_; }  // ns
  void compute(double milliseconds) noexcept {
    pass(milliseconds);
    processor_time_ += static_cast<std::int64_t>(milliseconds * 1e6);
  }
  void sleep_until(std::int64_t due) noexcept {
    now_ = std::max(now_, due);
    pass(std::exchange(oversleep_, 0));
  }
  // The next sleep ends so much too late.
  void oversleep(double milliseconds) noexcept { oversleep_ = milliseconds; }

  // As many times, a signal cuts a sleep short at its beginning.
  void interrupt(int times) noexcept { interruptions_ = times; }
  bool is_interrupted() noexcept { return interruptions_ > 0 && interruptions_-- > 0; }

 private:
  VirtualClock* outer_;
  std::int64_t now_ = 1'000'000'000, processor_time_ = 1'000'000'000;
  double oversleep_ = 0;  // ms
  int interruptions_ = 0;
};

}  // namespace forceshade::faults
