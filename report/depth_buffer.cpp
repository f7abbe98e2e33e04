// SPDX-License-Identifier: BSD-3-Clause
#include "report/depth_buffer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace forceshade::properties {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();  // the depth of a sample where nothing was drawn

// The light comes over the viewer's left shoulder. Neither end of the scale is reached, so that lines can be darker and the
// paper is brighter.
double brightness(const Eigen::Vector3d& unit_normal) {
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, 0.5, 0.8).normalized();
  return 0.3 + 0.6 * std::max(0.0, unit_normal.dot(light));
}

}  // namespace

Eigen::Vector3d ViewDirection::turned(const Eigen::Vector3d& vector) const {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  const Eigen::Vector3d right(std::cos(a), std::sin(a), 0);
  const Eigen::Vector3d towards(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
  return {right.dot(vector), towards.cross(right).dot(vector), towards.dot(vector)};
}

DepthBuffer::DepthBuffer(const SampleGrid& grid)
    : grid_(grid), samples_(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), {kNothing, 1}) {}

void DepthBuffer::draw(const std::array<Eigen::Vector3d, 3>& corners) {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Eigen::Vector3d facing = (normal.z() > 0 ? normal : Eigen::Vector3d(-normal)).normalized();
  draw(corners, static_cast<float>(std::copysign(brightness(facing), normal.z())), 0.7F);
}

void DepthBuffer::draw(const std::array<Eigen::Vector3d, 3>& corners, float value) {
  draw(corners, value, 1);
}

void DepthBuffer::draw(const std::array<Eigen::Vector3d, 3>& corners, float shade, float darker) {
  const auto& [a, b, c] = corners;
  const double twice_area = (b - a).cross(c - a).z();
  if (twice_area == 0) return;  // it is seen from the side

  std::array<double, 3> width{};  // of the triangle, from each corner to the side opposite to it
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d along = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    width[i] = std::fabs(twice_area) / std::hypot(along.x(), along.y());
  }
  const bool has_lines = *std::min_element(width.begin(), width.end()) >= 8 * grid_.spacing;

  const auto [low_x, high_x] = std::minmax({a.x(), b.x(), c.x()});
  const auto [low_y, high_y] = std::minmax({a.y(), b.y(), c.y()});
  const auto sample_of = [&](double coordinate, double from, int count) {
    return static_cast<int>(std::clamp((coordinate - from) / grid_.spacing - 0.5, -1.0, static_cast<double>(count)));
  };
  const int first = std::max(0, sample_of(low_x, grid_.left, grid_.columns));
  const int last = std::min(grid_.columns - 1, sample_of(high_x, grid_.left, grid_.columns) + 1);
  const int lowest = std::max(0, sample_of(low_y, grid_.bottom, grid_.rows));
  const int highest = std::min(grid_.rows - 1, sample_of(high_y, grid_.bottom, grid_.rows) + 1);
  for (int row = lowest; row <= highest; ++row)
    for (int column = first; column <= last; ++column) {
      const double x = grid_.left + (column + 0.5) * grid_.spacing, y = grid_.bottom + (row + 0.5) * grid_.spacing;
      std::array<double, 3> weight{};  // of the corners
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d &from = corners[(i + 1) % 3], &to = corners[(i + 2) % 3];
        weight[i] = ((to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x())) / twice_area;
      }
      if (*std::min_element(weight.begin(), weight.end()) < 0) continue;
      const auto depth = static_cast<float>(weight[0] * a.z() + weight[1] * b.z() + weight[2] * c.z());
      Sample& sample = samples_[index(column, row)];
      if (!(depth > sample.depth)) continue;
      bool is_on_line = false;
      for (std::size_t i = 0; i < 3; ++i) is_on_line = is_on_line || weight[i] * width[i] < 0.75 * grid_.spacing;
      sample = {depth, has_lines && is_on_line ? darker * shade : shade};
    }
}

bool DepthBuffer::hides(const Eigen::Vector3d& point) const {
  const int column = static_cast<int>(std::floor((point.x() - grid_.left) / grid_.spacing));
  const int row = static_cast<int>(std::floor((point.y() - grid_.bottom) / grid_.spacing));
  // On a slope the surface is nearer to the viewer at one of the samples around the point, and farther away at another one.
  float farthest = std::numeric_limits<float>::infinity();
  for (const int other_row : {row - 1, row, row + 1})
    for (const int other_column : {column - 1, column, column + 1}) {
      if (other_row < 0 || other_row >= grid_.rows || other_column < 0 || other_column >= grid_.columns) return false;
      farthest = std::min(farthest, samples_[index(other_column, other_row)].depth);
    }
  return static_cast<double>(farthest) > point.z() + grid_.spacing;
}

}  // namespace forceshade::properties
