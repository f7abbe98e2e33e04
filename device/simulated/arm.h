// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Kinematics and rigid-body dynamics of a PHANToM's three driven joints (device/simulated/model.md has the equations and their
// sources).
//
// SI units. The arm's own frame is x right, y up, z to the user; θ1 turns about y, θ2 is the upper arm's angle above the
// horizontal and θ3 the forearm's from hanging straight down, both absolute: a parallel linkage drives them from the base.

#include <Eigen/Core>
#include <optional>

namespace forceshade::device {

using Joints = Eigen::Vector3d;  // rad, or rad/s, N·m: one number a joint

// M of any such linkage: M11 = turn + turn_upper cos 2θ2 + turn_fore cos 2θ3 + coupling cos θ2 sin θ3, M22 = upper, M33 = fore,
// M23 = -½ coupling sin(θ2 - θ3), M12 = M13 = 0. All in kg·m².
struct Inertia {
  double turn, turn_upper, turn_fore, coupling, upper, fore;
};

// Angles with their sines and cosines, computed once for all that is computed of a pose.
struct Pose {
  Pose(const Joints& angles) noexcept;  // implicit: a pose is its angles

  double s1, c1, s2, c2, s3, c3;
};

struct Arm {
  double upper_length, fore_length;  // m
  Eigen::Vector3d shoulder;          // m
  Inertia inertia;
  double upper_weight, fore_weight;  // N·m: gravity holds the joints back with (0, upper_weight cos θ2, fore_weight sin θ3)

  Eigen::Vector3d forward(const Pose& pose) const noexcept;

  // None where no pose reaches; else the pose with the elbow up, as the linkage is built.
  std::optional<Joints> inverse(const Eigen::Vector3d& position) const noexcept;

  // ∂position/∂angles. A force f at the tip is held by motor torques Jᵀf.
  Eigen::Matrix3d jacobian(const Pose& pose) const noexcept;

  Eigen::Matrix3d mass(const Pose& pose) const noexcept;

  // ∂M/∂θ of one joint, 0 to 2.
  Eigen::Matrix3d mass_derivative(const Pose& pose, int joint) const noexcept;

  // C with M θ̈ + C θ̇ + gravity = torque, by Christoffel symbols: Ṁ - 2C is skew.
  Eigen::Matrix3d coriolis(const Pose& pose, const Joints& velocity) const noexcept;

  Joints gravity(const Pose& pose) const noexcept;

  double energy(const Pose& pose, const Joints& velocity) const noexcept;  // J, kinetic and potential
};

// The mass at the tip that would feel the same, kg: the matrix (J M⁻¹ Jᵀ)⁻¹.
Eigen::Matrix3d apparent_mass(const Arm& arm, const Pose& pose) noexcept;

// The frames of the arm and of docs/laws.md (x right, y into the page, z up) share their origin and differ by a quarter turn
// and by their units; the same turn takes forces.
Eigen::Vector3d turned_to_law(const Eigen::Vector3d& in_arm) noexcept;
Eigen::Vector3d turned_to_arm(const Eigen::Vector3d& in_law) noexcept;

inline constexpr double kMillimetre = 1e-3;  // m

}  // namespace forceshade::device
