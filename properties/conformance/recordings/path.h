// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The positions of a recording between its samples, since a force that comes late belongs to an earlier one.

#include <Eigen/Core>
#include <vector>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

// A cubic spline, whose accelerations go on through the samples: at 250 Hz it meets a motion of 1.5 mm at 15 Hz within 0.5 µm.
// Samples whose time is not after that of all before are left out.
class RecordedPath {
 public:
  explicit RecordedPath(const std::vector<Measured>& samples);

  // True if there is a position at the time of the sample less the lag (s).
  bool reaches(const Measured& sample, double lag) const;

  // mm, there; that of the sample itself without a lag, and on a straight line beyond the ends.
  Eigen::Vector3d position(const Measured& sample, double lag) const;

 private:
  struct Knot {
    double time;
    Eigen::Vector3d position, velocity;
  };
  std::vector<Knot> knots_;
};

}  // namespace forceshade::conformance
