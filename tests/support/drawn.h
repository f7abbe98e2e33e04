// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The number of random cases that a test draws.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace forceshade::tests {

// A quarter of `all`, which is what a plain run draws; with FORCESHADE_DRAWS=N in the environment, N times all. `ctest -C full`
// also runs each program whose CMakeLists.txt says DRAWS with N = 1. A larger N is for searches by hand.
inline std::size_t drawn(std::size_t all) {
  const char* const times = std::getenv("FORCESHADE_DRAWS");
  return times == nullptr ? (all + 3) / 4 : all * std::strtoull(times, nullptr, 10);
}

// The number of the first case: 0, or FORCESHADE_FIRST=N in the environment, for searches by hand in parts.
inline std::uint64_t first_drawn() {
  const char* const first = std::getenv("FORCESHADE_FIRST");
  return first == nullptr ? 0 : std::strtoull(first, nullptr, 10);
}

}  // namespace forceshade::tests
