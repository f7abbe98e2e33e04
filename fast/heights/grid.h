// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sampled map's cells and values, and its bilinear interpolant.

#include <memory>

#include "fast/heights/jet.h"
#include "fast/numbers/row.h"

namespace forceshade::fast {

class HeightGrid {
 public:
  explicit HeightGrid(std::shared_ptr<const height::Grid> grid) noexcept;

  // The fault of grid.cpp, as arithmetic_fault_here() of fast/numbers/arithmetic.h.
  static const char* arithmetic_fault() noexcept;

  struct Cell {
    std::int64_t column, row;
    Pair64 start;  // mm, exact: a multiple of pitch/2, at most 26 bits times 24
  };
  // The product is off by far less than 1, so the cell by one at most, which comparing with its exact ends puts right.
  FORCESHADE_INLINE Cell cell(const Place& at) const noexcept {
    const Pair64 place = at.coordinates * per_pitch() + (centre_ + kAbove);
    const auto column = static_cast<std::int32_t>(place[0]) - kAbove, row = static_cast<std::int32_t>(place[1]) - kAbove;
    const Pair64 index{static_cast<double>(column), static_cast<double>(row)};
    const Pair64 start = (index - centre_) * pitch_, end = (index + 1 - centre_) * pitch_;
    if (at.x() < start[0] || at.x() >= end[0] || at.y() < start[1] || at.y() >= end[1]) [[unlikely]]
      return corrected(column, row, at);
    return {column, row, start};
  }

  FORCESHADE_INLINE double pitch() const noexcept { return pitch_; }  // mm
  FORCESHADE_INLINE Pair64 pitches() const noexcept { return Pair64{pitch_, pitch_}; }
  FORCESHADE_INLINE Pair64 per_pitch() const noexcept { return Pair64{per_pitch_, per_pitch_}; }  // 1/mm, relative error 2^-53
  // The factors that turn p U_x and 2 p U_y into slopes: 1/p and 1/2p. 0 instead of 1/p where no step goes along x: then U_x is
  // 0, not what rounding leaves of it.
  FORCESHADE_INLINE Pair64 per_slope() const noexcept { return per_slope_; }
  // The largest differences between values side by side, tiled or not; mm.
  double largest_step_along() const noexcept { return largest_step_along_; }
  double largest_step_across() const noexcept { return largest_step_across_; }
  // True if the four by four values around a cell are all inside the grid.
  FORCESHADE_INLINE bool has_window_around(std::int32_t column, std::int32_t row) const noexcept {
    return static_cast<std::uint32_t>(column) - 1 < inner_columns_ && static_cast<std::uint32_t>(row) - 1 < inner_rows_;
  }
  FORCESHADE_INLINE std::uint32_t inner_columns() const noexcept { return inner_columns_; }
  FORCESHADE_INLINE std::uint32_t inner_rows() const noexcept { return inner_rows_; }
  FORCESHADE_INLINE const float* values() const noexcept { return values_; }
  FORCESHADE_INLINE std::int64_t columns() const noexcept { return columns_; }
  FORCESHADE_INLINE Pair64 centre() const noexcept { return centre_; }  // (columns - 1)/2, (rows - 1)/2
  height::Interpolant interpolant() const noexcept { return grid_->interpolant; }

  // kOrder rows of kOrder values from sample (i, j) on, where they are: a copy, whose writing would have to be waited for, is
  // made beyond the edge alone. Neither copied nor moved.
  template <std::size_t kOrder>
  class Window {
   public:
    FORCESHADE_INLINE Window(const HeightGrid& grid, std::int64_t i, std::int64_t j) noexcept {
      constexpr auto kSize = static_cast<std::int64_t>(kOrder);
      if (i < 0 || j < 0 || i + kSize > grid.columns_ || j + kSize > grid.rows_) [[unlikely]] {
        grid.copy_beyond_edge(i, j, kSize, beyond_edge_);
        from_ = beyond_edge_;
        stride_ = kSize;
      } else {
        from_ = grid.values_ + (j * grid.columns_ + i);
        stride_ = grid.columns_;
      }
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    FORCESHADE_INLINE const float* operator[](std::size_t row) const noexcept {
      return from_ + static_cast<std::int64_t>(row) * stride_;
    }
    FORCESHADE_INLINE std::int64_t stride() const noexcept { return stride_; }

   private:
    const float* from_;
    std::int64_t stride_;
    float beyond_edge_[kOrder * kOrder];
  };

 private:
  static constexpr int kAbove = 1 << 24;  // makes positive what the conversion rounds towards 0

  Cell corrected(std::int64_t column, std::int64_t row, const Place& at) const noexcept;
  void copy_beyond_edge(std::int64_t i, std::int64_t j, std::int64_t size, float* to) const noexcept;

  std::shared_ptr<const height::Grid> grid_;
  const float* values_;
  std::int64_t columns_, rows_;
  std::uint32_t inner_columns_, inner_rows_;
  double pitch_, per_pitch_;
  Pair64 centre_;
  double largest_step_along_, largest_step_across_;
  Pair64 per_slope_;
};

// The place of a position in its cell, 0 to 1 (t in x, s in y).
template <class N>
struct InCell {
  N t, s;

  InCell(const HeightGrid& grid, const Place& at, const HeightGrid::Cell& cell) noexcept
      : t((N::exactly(at.x()) - N::exactly(cell.start[0])) / N::exactly(grid.pitch())),
        s((N::exactly(at.y()) - N::exactly(cell.start[1])) / N::exactly(grid.pitch())) {}
};

// The jet is computed from differences of neighbouring values: where these are equal, the gradient is exactly 0 in every
// arithmetic.
template <class N>
Jet<N> bilinear_jet(const HeightGrid& grid, const Place& at) noexcept {
  const HeightGrid::Cell cell = grid.cell(at);
  const InCell<N> in(grid, at, cell);
  const HeightGrid::Window<2> w(grid, cell.column, cell.row);
  const auto rise = [](float from, float to) { return difference<N>(static_cast<double>(to), from); };
  const N along_0 = rise(w[0][0], w[0][1]), along_1 = rise(w[1][0], w[1][1]);
  const N across_0 = rise(w[0][0], w[1][0]), across_1 = rise(w[0][1], w[1][1]);
  const N one = N::exactly(1), pitch = N::exactly(grid.pitch());
  const N Ux = (one - in.s) * along_0 + in.s * along_1, Uy = (one - in.t) * across_0 + in.t * across_1;
  return {(N::exactly(static_cast<double>(w[0][0])) + in.t * along_0) + in.s * Uy, Ux / pitch, Uy / pitch};
}

}  // namespace forceshade::fast
