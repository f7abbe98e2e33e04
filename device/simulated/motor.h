// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A motor and its amplifier behind a gear: what torque comes out for a commanded one, and how that heats the motor.

#include "device/simulated/arm.h"

namespace forceshade::device {

struct Motor {
  double torque_constant;                         // N·m/A
  double continuous, stall;                       // N·m: for ever in a room at rated temperature, and the most for a moment
  double rotor_inertia;                           // kg·m²
  double winding_time, housing_time;              // s
  double winding_resistance, housing_resistance;  // K/W: winding to housing, housing to room
  int amplifier_bits;                             // from -stall to stall; 0: continuous
};

// Rises over the room's temperature, in shares of the highest the winding may have: `continuous` for ever leads to 1.
struct Heat {
  double winding = 0;  // over the housing
  double housing = 0;
  double total() const noexcept { return winding + housing; }
};

Heat heated(const Motor& motor, Heat heat, double torque, double seconds) noexcept;

// The most torque a motor this warm gives: `stall` up to kDeratingStart, then falling in a straight line through `continuous`
// at 1 to nothing, so that no command makes it much warmer than that.
inline constexpr double kDeratingStart = 0.9;
double torque_limit(const Motor& motor, const Heat& heat) noexcept;

// The torque at the joints when `torque` is commanded. A limit shortens the whole vector: a force that is too large keeps
// its direction, which is what force shading is about. Then the current is rounded to the amplifier's nearest step.
Joints delivered(const Motor& motor, const Eigen::Vector3d& gears, const Eigen::Vector3d& limits,
                 const Joints& torque) noexcept;

}  // namespace forceshade::device
