// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Samples of which every byte is known, so that a recording shows which of them it has, and that they are as they were pushed.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "forceshade/recording.h"

namespace forceshade::recorder {

// Every byte differs from tick to tick, and every member from the others.
inline device::Sample sample(std::uint64_t tick) {
  device::Sample s;
  unsigned char bytes[sizeof s];
  for (std::size_t i = 0; i < sizeof s; ++i) bytes[i] = static_cast<unsigned char>((tick * 7 + i * 13) ^ (tick >> 8));
  std::memcpy(&s, bytes, sizeof s);
  s.tick = tick;
  return s;
}

inline std::vector<device::Sample> samples_of(const std::string& path) {
  std::vector<device::Sample> all;
  Recording(path).for_each_chunk(
      [&](std::span<const device::Sample> chunk) { all.insert(all.end(), chunk.begin(), chunk.end()); });
  return all;
}

// 0, 1, 2, ... as they were pushed.
inline void expect_ticks(const std::vector<device::Sample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const device::Sample expected = sample(k);
    ASSERT_EQ(std::memcmp(&samples[k], &expected, sizeof expected), 0) << "tick " << k;
  }
}

}  // namespace forceshade::recorder
