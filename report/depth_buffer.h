// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Triangles as they are seen from one direction: which of them is in front, and how bright it is, at each sample of a picture.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

namespace forceshade::properties {

// The direction from which an object is seen, without perspective. At azimuth 0 and elevation 0 the viewer looks along +y,
// with x to the right and z up. The azimuth turns the viewer about z, from -y towards +x; the elevation lifts the viewer above
// the plane of x and y.
struct ViewDirection {
  double azimuth = 30, elevation = 25;  // degrees

  // (to the right, up, towards the viewer) of a point or a vector; a length stays what it is.
  Eigen::Vector3d turned(const Eigen::Vector3d& vector) const;
};

// The rectangle of the picture that is covered with samples, in the units of the turned points.
struct SampleGrid {
  double left, bottom, spacing;  // of the lower left corner; between two samples
  int columns, rows;
};

// A depth buffer for pictures: it computes in binary64 without bounds of errors.
class DepthBuffer {
 public:
  explicit DepthBuffer(const SampleGrid& grid);

  // A triangle whose corners have been turned; what is outside the rectangle is not drawn. One that is at least eight samples
  // wide everywhere has darker lines along its sides.
  void draw(const std::array<Eigen::Vector3d, 3>& corners);
  // The same with a number of at least 0 in the place of the brightness, on both sides and without lines.
  void draw(const std::array<Eigen::Vector3d, 3>& corners, float value);

  // True if a triangle lies between the point, which has been turned, and the viewer. A point within a sample in front of the
  // surface is on it and is not hidden; nor is one outside the rectangle.
  bool hides(const Eigen::Vector3d& point) const;

  // At a sample, counted from the lower left: from 0, dark, to 1, where nothing was drawn. Negative where the triangle in front
  // shows its back.
  float shade(int column, int row) const { return samples_[index(column, row)].shade; }

  bool is_covered(int column, int row) const { return !std::isinf(samples_[index(column, row)].depth); }

 private:
  struct Sample {
    float depth, shade;
  };

  // shade: of a sample, of which lines are darker.
  void draw(const std::array<Eigen::Vector3d, 3>& corners, float shade, float darker);

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) + static_cast<std::size_t>(column);
  }

  SampleGrid grid_;
  std::vector<Sample> samples_;
};

}  // namespace forceshade::properties
