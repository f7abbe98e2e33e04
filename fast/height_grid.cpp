// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/height_grid.h"

#include <algorithm>
#include <cmath>

namespace forceshade::fast {

HeightGrid::HeightGrid(std::shared_ptr<const height::Grid> grid) noexcept
    : grid_(std::move(grid)),
      values_(grid_->values.data()),
      columns_(grid_->columns),
      rows_(grid_->rows),
      pitch_(static_cast<double>(grid_->pitch)),
      per_pitch_(1 / pitch_),
      per_twelve_pitches_(1 / (12 * pitch_)),
      centre_{0.5 * static_cast<double>(columns_ - 1), 0.5 * static_cast<double>(rows_ - 1)} {
  for (std::int64_t j = 0; j < rows_; ++j) {
    const float* row = values_ + j * columns_;
    const float* next = values_ + (j + 1) % rows_ * columns_;
    const auto raise = [](double& largest, float a, float b) {
      largest = std::max(largest, std::fabs(static_cast<double>(a) - static_cast<double>(b)));
    };
    for (std::int64_t i = 0; i < columns_; ++i) {
      raise(largest_value_, row[i], 0);
      raise(largest_step_along_, row[i], row[i + 1 < columns_ ? i + 1 : 0]);
      raise(largest_step_across_, row[i], next[i]);
    }
  }
}

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

}  // namespace forceshade::fast
