// SPDX-License-Identifier: BSD-3-Clause
#include "device/timing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace forceshade::device {
namespace {

// Below 64 ns each nanosecond has its bucket; above, the six leading bits choose it.
std::size_t bucket_of(std::uint64_t nanoseconds) noexcept {
  const int dropped = std::max(0, static_cast<int>(std::bit_width(nanoseconds)) - 6);
  return 32 * static_cast<std::size_t>(dropped) + static_cast<std::size_t>(nanoseconds >> dropped);
}

// The longest duration of a bucket.
std::int64_t end_of(std::size_t bucket) noexcept {
  const std::size_t dropped = bucket < 64 ? 0 : bucket / 32 - 1;
  return static_cast<std::int64_t>(((bucket - 32 * dropped + 1) << dropped) - 1);
}

}  // namespace

void Histogram::add(std::int64_t nanoseconds) noexcept {
  const std::int64_t counted = std::max<std::int64_t>(nanoseconds, 0);
  ++counts_[bucket_of(static_cast<std::uint64_t>(counted))];
  ++total_;
  max_ = std::max(max_, counted);
}

Durations Histogram::durations() const {
  Durations durations;
  const auto microseconds = [&](std::size_t bucket) { return static_cast<double>(std::min(end_of(bucket), max_)) / 1e3; };
  for (std::size_t k = 0; k < kBuckets; ++k)
    if (counts_[k] > 0) durations.histogram.push_back({microseconds(k), counts_[k]});
  const auto percentile = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(total_));
    std::uint64_t seen = 0;
    for (const auto& [up_to, count] : durations.histogram)
      if (static_cast<double>(seen += count) >= rank) return up_to;
    return 0.0;
  };
  durations.p50 = percentile(0.5);
  durations.p99 = percentile(0.99);
  durations.p999 = percentile(0.999);
  durations.p9999 = percentile(0.9999);
  durations.max = static_cast<double>(max_) / 1e3;
  return durations;
}

}  // namespace forceshade::device
