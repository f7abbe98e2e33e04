// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/motor.h"

#include <algorithm>
#include <cmath>

namespace forceshade::device {

Heat heated(const Motor& motor, Heat heat, double torque, double seconds) noexcept {
  const double power = (torque / motor.continuous) * (torque / motor.continuous);  // of the rated loss: I²R
  const double winding_share = motor.winding_resistance / (motor.winding_resistance + motor.housing_resistance);
  const double winding_end = power * winding_share, housing_end = power * (1 - winding_share);
  heat.winding = winding_end + (heat.winding - winding_end) * std::exp(-seconds / motor.winding_time);
  heat.housing = housing_end + (heat.housing - housing_end) * std::exp(-seconds / motor.housing_time);
  return heat;
}

double torque_limit(const Motor& motor, const Heat& heat) noexcept {
  const double share = std::min(1.0, (1 - heat.total()) / (1 - kDeratingStart));
  return std::max(0.0, motor.continuous + (motor.stall - motor.continuous) * share);
}

Joints delivered(const Motor& motor, const Eigen::Vector3d& gears, const Eigen::Vector3d& limits,
                 const Joints& torque) noexcept {
  Eigen::Vector3d at_motor = torque.cwiseQuotient(gears);
  double excess = 1;
  for (int i = 0; i < 3; ++i)
    if (std::abs(at_motor[i]) > excess * limits[i]) excess = std::abs(at_motor[i]) / limits[i];  // no limit left: infinite
  at_motor /= excess;
  if (motor.amplifier_bits > 0) {
    const double current_step = 2 * motor.stall / motor.torque_constant / std::ldexp(1, motor.amplifier_bits);  // A
    for (double& x : at_motor)
      x = std::nearbyint(x / motor.torque_constant / current_step) * current_step * motor.torque_constant;
  }
  return at_motor.cwiseProduct(gears);
}

}  // namespace forceshade::device
