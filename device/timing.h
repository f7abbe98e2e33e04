// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How long things took: a histogram that a real-time thread fills, and what it shows afterwards.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace forceshade::device {

// Durations in µs; percentiles by nearest rank, at most 1/32 too high. All zero if nothing was counted.
struct Durations {
  double p50 = 0, p99 = 0, p999 = 0, p9999 = 0;
  double max = 0;  // exact
  struct Bucket {
    double up_to;  // µs
    std::uint64_t count;
  };
  std::vector<Bucket> histogram;  // those that are not empty, in order
};

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
