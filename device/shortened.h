// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A limit on a force shortens the vector and keeps its direction, which is what force shading is about.

#include <Eigen/Core>

namespace forceshade::device {

// `force` itself if it is no longer than `most` >= 0, else along it and never longer than `most`: 2^-22 is more than all the
// rounding there is.
inline Eigen::Vector3f shortened(const Eigen::Vector3f& force, double most) noexcept {
  const Eigen::Vector3d exact = force.cast<double>();
  const double length = exact.norm();
  if (length <= most) return force;
  return (exact * (most / length * (1 - 0x1p-22))).cast<float>();
}

}  // namespace forceshade::device
