// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "forceshade/servo_loop.h"

namespace forceshade::device {
namespace {

std::vector<std::uint64_t> kept(double seconds, double rate, std::uint64_t ticks) {
  LastSamples last(seconds, rate);
  for (std::uint64_t tick = 0; tick < ticks; ++tick) last.push({.tick = tick, .wall_ns = static_cast<std::int64_t>(tick)});
  last.push({.tick = ticks, .status = Sample::kEnd});
  std::vector<std::uint64_t> result;
  for (const Sample& sample : last.samples()) {
    EXPECT_EQ(sample.wall_ns, static_cast<std::int64_t>(sample.tick));
    result.push_back(sample.tick);
  }
  return result;
}

TEST(last_samples, are_those_of_so_long_before_the_last_one) {
  EXPECT_EQ(kept(0.003, 1000, 9), (std::vector<std::uint64_t>{5, 6, 7, 8}));
  EXPECT_EQ(kept(0.2, 1000, 1000).size(), 201U);
  EXPECT_EQ(kept(0.2, 1000, 1000).front(), 799U);
  EXPECT_EQ(kept(0.2, 10'000, 5000).size(), 2001U);
}

TEST(last_samples, are_all_of_a_run_that_was_shorter) {
  EXPECT_EQ(kept(0.003, 1000, 0), std::vector<std::uint64_t>{});
  EXPECT_EQ(kept(0.003, 1000, 3), (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(kept(0.003, 1000, 4), (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace forceshade::device
