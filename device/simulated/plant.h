// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The moving parts: the arm with its friction and, if one holds it, the hand. Integrated at a fixed step by Runge and Kutta's
// fourth-order method; the same inputs give the same bits.

#include <optional>

#include "device/simulated/arm.h"
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

// Coulomb friction of joints that are coupled by a mass matrix. A joint at rest stays at exactly rest as long as its friction
// can hold it: no band of creep around zero speed, so nothing chatters.

// The way each joint slips in a time step: +1 or -1, or 0 where it sticks.
using Slip = Eigen::Vector3i;

// A joint that moves slips the way it moves. One at rest sticks if some friction of at most `coulomb` keeps it there, given
// what the others do: solved for all of them together by projected Gauss-Seidel. Without friction nothing sticks.
Slip slip_of(const Eigen::Matrix3d& mass, const Joints& torque, const Joints& velocity, const Joints& coulomb) noexcept;

// M⁻¹(torque - friction), with the sticking joints held.
Joints acceleration(const Eigen::Matrix3d& mass, const Joints& torque, const Slip& slip, const Joints& coulomb) noexcept;

// At the end of a step, joints that reversed have passed rest: they stop, and pass their momentum on through M. Never
// increases the kinetic energy.
Joints stopped_where_reversed(const Eigen::Matrix3d& mass, const Joints& velocity, const Slip& slip,
                              const Joints& coulomb) noexcept;

}  // namespace forceshade::device
