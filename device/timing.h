// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Durations: a histogram that a real-time thread fills, and what it shows afterwards.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

class Histogram {
 public:
  // A negative duration counts as zero.
  void add(std::int64_t nanoseconds) noexcept;

  Durations durations() const;

 private:
  // 32 buckets an octave, up to the longest that an int64 holds.
  static constexpr std::size_t kBuckets = 1888;
  std::array<std::uint64_t, kBuckets> counts_{};
  std::uint64_t total_ = 0;
  std::int64_t max_ = 0;
};

}  // namespace forceshade::device
