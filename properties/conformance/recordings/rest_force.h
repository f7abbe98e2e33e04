// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the force sensor's reading out of contact, before the place of the surface is known.

#include <Eigen/Core>
#include <vector>

#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

struct RestForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // N
  double noise = 0;                                 // N, the standard deviation of a component
};

// The force around which a tenth of the samples lie closest together: a hand in the air feels the same force wherever it is. Of
// a hand that never leaves the surface it is some force. There is one sample at least, and all forces are finite.
RestForce rest_force_of(const std::vector<Measured>& samples);

// The distance (N) that the fitted offset may have from what the sensor reads of no force: that from the nearest of these, at
// least a millionth and at most a thousandth of the largest force. No fit finds it to the last digit, nor noisy positions to
// many.
double doubt_of(const Eigen::Vector3d& offset, const std::vector<RestForce>& rests, double largest);

}  // namespace forceshade::conformance
