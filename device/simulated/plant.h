// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The moving parts: the arm with its friction and, if one holds it, the hand. Integrated at a fixed step by Runge and Kutta's
// fourth-order method; the same inputs give the same bits.

#include <optional>

#include "device/simulated/friction.h"
#include "device/simulated/hand.h"

namespace forceshade::device {

// SI units, the arm's frame. The hand's mass is where it meets the flesh of the fingers.
struct Motion {
  Joints angles{0, 0, 0}, velocity{0, 0, 0};
  Eigen::Vector3d hand{0, 0, 0}, hand_velocity{0, 0, 0};
};

// A target's way through one period: the cubic that has its positions and velocities at both ends.
struct HermiteStep {
  Eigen::Vector3d from{0, 0, 0}, from_velocity{0, 0, 0}, to{0, 0, 0}, to_velocity{0, 0, 0};  // m, m/s
};

struct Plant {
  Arm arm;
  Joints coulomb, viscous;  // N·m, N·m·s/rad
  std::optional<Grip> grip;

  // `steps` equal steps through `period` seconds, the motors' torque held.
  Motion advanced(Motion motion, const Joints& torque, const HermiteStep& way, double period, int steps) const noexcept;
};

}  // namespace forceshade::device
