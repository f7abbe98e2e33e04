// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exhaustive sweeps: every binary32 of one coordinate, at one value of the other, and the record of having checked them.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/law.h"

namespace forceshade::properties {

// direction: every x of the bump on z = -1 mm, where the force of a flat shaded law is K times its direction.
// height: every x of the bump, where the highest position in contact and the lowest free one must be distinguished; for a law
//   whose surface is flat, every z on x = 0.
// line: every x on a chosen z. column: every z on a chosen x.
enum class SweepKind { direction, height, line, column };
inline constexpr std::array<std::string_view, 4> kSweepKinds{"direction", "height", "line", "column"};

struct Sweep {
  LawId law = LawId::wall;
  Parameters parameters;
  SweepKind kind = SweepKind::direction;
  float at = 0;  // mm: the coordinate that is fixed; 0 for the heights of a curved surface

  friend bool operator==(const Sweep&, const Sweep&) = default;
};

struct SweepResult {
  Sweep sweep;
  std::uint64_t inputs = 0, mismatches = 0;
};

// A sweep is done in units: 2^22 bit patterns, each with both signs.
inline constexpr std::uint32_t kUnitBits = 22;
inline constexpr std::uint64_t kUnitsPerSweep = std::uint64_t{1} << (31 - kUnitBits);

// Some or all units of a list of sweeps, in order: sweep by sweep, small magnitudes first.
struct Sweeps {
  std::uint64_t first = 0, end = 0;          // units to do
  std::uint64_t next = 0;                    // units from first to next are done
  double seconds = 0;                        // spent on them
  std::array<std::uint64_t, 3> stages{};     // inputs that the fast path decided in binary64, double-double, wide
  std::vector<SweepResult> results;          // of all sweeps, also of those that have no unit here
  std::vector<std::string> counterexamples;  // the first few

  std::uint64_t units() const { return kUnitsPerSweep * results.size(); }
  bool is_finished() const { return next == end; }
  bool is_whole() const { return is_finished() && first == 0 && end == units(); }
  std::uint64_t inputs() const { return sum(&SweepResult::inputs); }
  std::uint64_t mismatches() const { return sum(&SweepResult::mismatches); }

 private:
  std::uint64_t sum(std::uint64_t SweepResult::*count) const {
    std::uint64_t total = 0;
    for (const SweepResult& result : results) total += result.*count;
    return total;
  }
};

// All sweeps of one law and kind together.
struct SweepTotal {
  LawId law;
  SweepKind kind;
  std::vector<float> radii;  // mm; none for the wall
  std::uint64_t sweeps = 0, inputs = 0, mismatches = 0;
};
std::vector<SweepTotal> totals(const Sweeps& sweeps);

// Which kinds to sweep; line and column go together.
struct SweepPlan {
  std::vector<LawId> laws;
  Parameters parameters;     // width and stiffness of all, radius of lines and columns
  std::vector<float> radii;  // mm: of directions and heights
  bool directions = true, heights = true, lines = true;
};

// Throws std::invalid_argument naming the parameter if one is outside the domain of one of the laws.
Sweeps planned(const SweepPlan& plan);

// Part k of n of them, nothing done yet (1 <= k <= n).
Sweeps part_of(Sweeps sweeps, std::uint64_t k, std::uint64_t n);

// Does the next `count` units, or as many as are left. Any number of threads gives the same result but for the seconds.
Sweeps continued(Sweeps sweeps, std::uint64_t count, unsigned threads);

}  // namespace forceshade::properties
