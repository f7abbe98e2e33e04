// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The truth along a run of consecutive binary32, for sweeps over all of them: one evaluation of the law on a Taylor number
// rounds nearly every position of the run, with proof; the few it leaves open go to Law::round_to_binary32 one by one.

#include <array>
#include <bit>
#include <cstdint>

#include "forceshade/reference.h"

namespace forceshade::reference {

inline constexpr std::size_t kRun = 1024;

// The coordinate whose bit pattern counts up; the other one is fixed.
enum class Along { x, z };

// The i-th coordinate of the run that begins at a bit pattern; every run begins at a multiple of kRun.
inline float coordinate_of_run(std::uint32_t first, std::size_t i) {
  return std::bit_cast<float>(first + static_cast<std::uint32_t>(i));
}

struct RoundedRun {
  std::array<float, kRun> x{}, z{};  // N
  std::array<Status, kRun> status{};
  std::size_t one_by_one = 0;  // positions the Taylor number left open
};

// fixed: mm, the other coordinate.
RoundedRun round_run(const Law& law, Along along, float fixed, std::uint32_t first);

// The highest binary32 position in contact and the next one, which is free, for every x of a run with 2|x| <= w. A position
// below the quantum counts as 0, so the neighbours of 0 are ±2^-30 mm.
struct SurfaceRun {
  std::array<float, kRun> contact{}, free{};  // mm
  std::size_t count = 0;                      // of x with 2|x| <= w; the run's first ones
  std::size_t one_by_one = 0;
};

// Not for the cylinder or bump-cylinder with w = 2R, whose ends |x| = R have no position in contact above the axis.
SurfaceRun surface_run(const Law& law, std::uint32_t first);

}  // namespace forceshade::reference
