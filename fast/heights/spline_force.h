// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The first stage of a map that is one B-spline and no more: from a position to its force, in one function per instruction set.

#include "fast/heights/force.h"
#include "fast/heights/spline.h"
#include "fast/numbers/arithmetic.h"

namespace forceshade::fast {

// Such a map with all that its force takes.
struct SplineMap {
  HeightGrid grid;
  height::Mode mode;
  double K;  // N/mm
  CertaintyThresholds sure;

  SplineMap(const HeightGrid& spline, height::Mode how, double stiffness) noexcept : grid(spline), mode(how), K(stiffness) {
    // Clamping steps to 2^-40 mm sends subnormal results to a later stage; rounding_is_in_doubt requires normal ones.
    const auto counted = [](double step) { return step > 0 ? larger(step, 0x1p-40) : 0; };
    const SplineErrors error(grid, counted(grid.largest_step_along()), counted(grid.largest_step_across()));
    sure = {error.rise / kErrorBudgetShare, error.Ux / kErrorBudgetShare, error.Uy / kErrorBudgetShare};
  }
};

// The cell of a plain position, or one beside it that the position is within 2^-36 of a cell of: as good, for the spline's
// patches meet with equal second derivatives (docs/proofs.md). Four: as in SplineValues.
template <class Four>
struct NearCell {
  std::int32_t column, row;
  Pair64 past;  // the position less the cell's start, mm

  FORCESHADE_INLINE NearCell(const HeightGrid& grid, const Pair64& at) noexcept {
    const Pair32 index = truncated(Four::multiply_add_pairs(at, grid.per_pitch(), grid.centre()));
    column = index.first;
    row = index.second;
    const Pair64 from_start = grid.centre() - Pair64{static_cast<double>(column), static_cast<double>(row)};
    past = Four::multiply_add_pairs(from_start, grid.pitches(), at);
  }
};

// position: x, y, z, mm; force: three numbers, N, left alone if the answer is unknown: the position is not plain, its window
// not inside the grid, or the map's errors leave more than one answer.
template <class Four>
FORCESHADE_INLINE Sign spline_force(const SplineMap& map, const float* position, float* force) noexcept {
  if (!is_plain(position[0]) || !is_plain(position[1]) || !is_plain(position[2])) [[unlikely]]
    return Sign::unknown;
  const NearCell<Four> cell(map.grid, to_binary64(position[0], position[1]));
  if (!map.grid.has_window_around(cell.column, cell.row)) [[unlikely]]
    return Sign::unknown;
  const std::int64_t stride = map.grid.columns();
  const float* window = map.grid.values() + ((cell.row - 1) * stride + (cell.column - 1));
  const SplineValues<Four> jet(map.grid, cell.past, window, stride);
  const auto depth = -static_cast<double>(position[2]);
  const bool is_shaded = map.mode == height::Mode::force_shaded;
  const double gap = is_shaded ? depth : jet.rise + (jet.c + depth);
  const CertaintyThresholds sure{is_shaded ? 0 : map.sure.gap, map.sure.Ux, map.sure.Uy};
  HeightForce answer = height_force(gap, jet.Ux, jet.Uy, sure, map.mode, map.K);
  if (answer.contact == Sign::unknown) [[unlikely]] {
    // Near a tie, level ground or the surface: too near for one bound of all that is lost, mostly not for a bound of each part.
    const double gap_error = is_shaded ? 0 : kErrorBudgetShare * sure.gap + 0x1p-51 * absolute(gap);  // the second: for c - z
    const Jet<DoubleWithError> bounded{
        {gap, gap_error}, {jet.Ux, kErrorBudgetShare * sure.Ux}, {jet.Uy, kErrorBudgetShare * sure.Uy}};
    answer = height_force(bounded, map.mode, map.K, 0);
    if (answer.contact == Sign::unknown) return Sign::unknown;
  }
  force[0] = answer.x;
  force[1] = answer.y;
  force[2] = answer.z;
  return answer.contact;
}

using SplineForce = Sign (*)(const SplineMap& map, const float* position, float* force) noexcept;

struct SplineFunctions {
  SplineForce force;
  const char* (*arithmetic_fault_here)();
};

extern const SplineFunctions kAvx2SplineFunctions;

// Several at a time: x, y, z of each position one after the other, forces likewise. Those whose bit is set in the answer are
// known, the others mean nothing.
inline constexpr std::size_t kSplineBatch = 8;
struct SplineBatchFunctions {
  unsigned (*forces)(const SplineMap& map, const float* positions, float* forces) noexcept;
  const char* (*arithmetic_fault_here)();
};

extern const SplineBatchFunctions kAvx512SplineFunctions;

}  // namespace forceshade::fast
