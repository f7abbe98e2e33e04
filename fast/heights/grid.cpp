// SPDX-License-Identifier: BSD-3-Clause
#include "fast/heights/grid.h"

#include <algorithm>
#include <cmath>

#include "fast/numbers/arithmetic.h"

namespace forceshade::fast {
namespace {

// The largest difference between a value and the one (right, up) samples from it, beyond the edge as if tiled.
double largest_step(const height::Grid& grid, std::size_t right, std::size_t up) noexcept {
  double largest = 0;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    const float *row = grid.values.data() + j * grid.columns, *other = grid.values.data() + (j + up) % grid.rows * grid.columns;
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const float next = other[i + right < grid.columns ? i + right : 0];
      largest = std::max(largest, std::fabs(static_cast<double>(row[i]) - static_cast<double>(next)));
    }
  }
  return largest;
}

}  // namespace

HeightGrid::HeightGrid(std::shared_ptr<const height::Grid> grid) noexcept
    : grid_(std::move(grid)),
      values_(grid_->values.data()),
      columns_(grid_->columns),
      rows_(grid_->rows),
      inner_columns_(grid_->columns > 3 ? grid_->columns - 3 : 0),
      inner_rows_(grid_->rows > 3 ? grid_->rows - 3 : 0),
      pitch_(static_cast<double>(grid_->pitch)),
      per_pitch_(1 / pitch_),
      centre_{0.5 * static_cast<double>(columns_ - 1), 0.5 * static_cast<double>(rows_ - 1)},
      largest_step_along_(largest_step(*grid_, 1, 0)),
      largest_step_across_(largest_step(*grid_, 0, 1)),
      per_slope_{largest_step_along_ > 0 ? per_pitch_ : 0, per_pitch_ / 2} {}

[[gnu::noinline]] HeightGrid::Cell HeightGrid::corrected(std::int64_t column, std::int64_t row,
                                                         const Place& at) const noexcept {
  const auto start = [&](std::int64_t index, double centre) { return (static_cast<double>(index) - centre) * pitch_; };
  const auto correct = [&](std::int64_t index, double centre, double coordinate) {
    if (coordinate < start(index, centre)) return index - 1;
    return coordinate >= start(index + 1, centre) ? index + 1 : index;
  };
  column = correct(column, centre_[0], at.x());
  row = correct(row, centre_[1], at.y());
  return {column, row, Pair64{start(column, centre_[0]), start(row, centre_[1])}};
}

[[gnu::noinline]] void HeightGrid::copy_beyond_edge(std::int64_t i, std::int64_t j, std::int64_t size,
                                                    float* to) const noexcept {
  const auto kept = [&](std::int64_t index, std::int64_t count) {
    if (grid_->edge == height::Edge::tile) return (index % count + count) % count;
    return std::clamp<std::int64_t>(index, 0, count - 1);
  };
  for (std::int64_t l = 0; l < size; ++l)
    for (std::int64_t k = 0; k < size; ++k) *to++ = values_[kept(j + l, rows_) * columns_ + kept(i + k, columns_)];
}

const char* HeightGrid::arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
