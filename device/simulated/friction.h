// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Coulomb friction of joints that are coupled by a mass matrix. A joint at rest stays at exactly rest as long as its friction
// can hold it: no band of creep around zero speed, so nothing chatters.

#include "device/simulated/arm.h"

namespace forceshade::device {

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
