// SPDX-License-Identifier: BSD-3-Clause
#include "device/timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace forceshade::device {
namespace {

TEST(timing, counts_none_short_durations_by_the_nanosecond_and_the_longest_there_is) {
  Histogram histogram;
  EXPECT_EQ(histogram.durations().p50 + histogram.durations().p9999 + histogram.durations().max, 0);
  EXPECT_TRUE(histogram.durations().histogram.empty());
  for (const std::int64_t ns : {63, 0, 5, 5, -7}) histogram.add(ns);
  const Durations us = histogram.durations();
  ASSERT_EQ(us.histogram.size(), 3U);
  EXPECT_EQ(us.histogram[0].up_to, 0);
  EXPECT_EQ(us.histogram[0].count, 2U);
  EXPECT_EQ(us.histogram[1].up_to, 0.005);
  EXPECT_EQ(us.histogram[1].count, 2U);
  EXPECT_EQ(us.p50, 0.005);
  EXPECT_EQ(us.max, 0.063);
  Histogram longest;
  longest.add(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(longest.durations().max, 9223372036854775.807);
  EXPECT_EQ(longest.durations().p50, 9223372036854775.807);
}

// Against the sorted durations themselves, over ten binades.
TEST(timing, percentiles_are_the_nearest_rank_and_at_most_a_32nd_too_high) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {1U, 2U, 99U, 100U, 101U, 10'000U, 30'001U}) {
    Histogram histogram;
    std::vector<std::int64_t> all;
    for (std::size_t k = 0; k < count; ++k) {
      const auto ns = static_cast<std::int64_t>(std::exp2(10.0 * static_cast<double>(random() % 1000) / 1000 + 5));
      histogram.add(ns);
      all.push_back(ns);
    }
    std::sort(all.begin(), all.end());
    const Durations us = histogram.durations();
    const auto expect = [&](double got, std::size_t per_myriad) {
      const double exact = static_cast<double>(all[(count * per_myriad + 9999) / 10'000 - 1]) / 1e3;
      EXPECT_GE(got, exact) << count << " " << per_myriad;
      EXPECT_LE(got, exact * (1 + 1.0 / 32)) << count << " " << per_myriad;
    };
    expect(us.p50, 5000);
    expect(us.p99, 9900);
    expect(us.p999, 9990);
    expect(us.p9999, 9999);
    EXPECT_EQ(us.max, static_cast<double>(all.back()) / 1e3);
    std::uint64_t counted = 0;
    double last = -1;
    for (const auto& [up_to, in_bucket] : us.histogram) {
      EXPECT_GT(up_to, last);
      last = up_to;
      counted += in_bucket;
    }
    EXPECT_EQ(counted, count);
  }
}

}  // namespace
}  // namespace forceshade::device
