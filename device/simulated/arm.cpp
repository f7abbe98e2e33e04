// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/arm.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace forceshade::device {
namespace {

// At full reach a rounded cosine can pass 1.
double angle_of_cosine(double cosine) noexcept {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

Pose::Pose(const Joints& angles) noexcept
    : s1(std::sin(angles[0])),
      c1(std::cos(angles[0])),
      s2(std::sin(angles[1])),
      c2(std::cos(angles[1])),
      s3(std::sin(angles[2])),
      c3(std::cos(angles[2])) {}

Eigen::Vector3d Arm::forward(const Pose& pose) const noexcept {
  const auto [s1, c1, s2, c2, s3, c3] = pose;
  const double r = upper_length * c2 + fore_length * s3, up = upper_length * s2 - fore_length * c3;
  return shoulder + Eigen::Vector3d(r * s1, up, r * c1);
}

std::optional<Joints> Arm::inverse(const Eigen::Vector3d& position) const noexcept {
  const Eigen::Vector3d p = position - shoulder;
  const double level = std::hypot(p.x(), p.z()), reach = std::hypot(level, p.y());
  if (!(reach <= upper_length + fore_length && reach >= std::abs(upper_length - fore_length) && reach > 0)) return std::nullopt;
  const double u2 = upper_length * upper_length, f2 = fore_length * fore_length, p2 = reach * reach;
  const double at_shoulder = angle_of_cosine((u2 + p2 - f2) / (2 * upper_length * reach));
  const double at_elbow = angle_of_cosine((u2 + f2 - p2) / (2 * upper_length * fore_length));
  const double upper = std::atan2(p.y(), level) + at_shoulder;
  return Joints(std::atan2(p.x(), p.z()), upper, upper + at_elbow - std::numbers::pi / 2);
}

Eigen::Matrix3d Arm::jacobian(const Pose& pose) const noexcept {
  const auto [s1, c1, s2, c2, s3, c3] = pose;
  const double us = upper_length * s2, uc = upper_length * c2, fs = fore_length * s3, fc = fore_length * c3, r = uc + fs;
  return Eigen::Matrix3d{{r * c1, -us * s1, fc * s1}, {0, uc, fs}, {-r * s1, -us * c1, fc * c1}};
}

Eigen::Matrix3d Arm::mass(const Pose& pose) const noexcept {
  const auto [s1, c1, s2, c2, s3, c3] = pose;
  const double turn = inertia.turn + inertia.turn_upper * (c2 * c2 - s2 * s2) + inertia.turn_fore * (c3 * c3 - s3 * s3) +
                      inertia.coupling * c2 * s3;
  const double between = -0.5 * inertia.coupling * (s2 * c3 - c2 * s3);
  return Eigen::Matrix3d{{turn, 0, 0}, {0, inertia.upper, between}, {0, between, inertia.fore}};
}

Eigen::Matrix3d Arm::mass_derivative(const Pose& pose, int joint) const noexcept {
  Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
  if (joint == 0) return d;
  const auto [s1, c1, s2, c2, s3, c3] = pose;
  const double between = 0.5 * inertia.coupling * (c2 * c3 + s2 * s3);
  d(0, 0) = joint == 1 ? -4 * inertia.turn_upper * s2 * c2 - inertia.coupling * s2 * s3
                       : -4 * inertia.turn_fore * s3 * c3 + inertia.coupling * c2 * c3;
  d(1, 2) = d(2, 1) = joint == 1 ? -between : between;
  return d;
}

Eigen::Matrix3d Arm::coriolis(const Pose& pose, const Joints& velocity) const noexcept {
  const std::array d{mass_derivative(pose, 0), mass_derivative(pose, 1), mass_derivative(pose, 2)};
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      c(i, j) = 0;
      for (int k = 0; k < 3; ++k)
        c(i, j) += 0.5 *
                   (d[static_cast<std::size_t>(k)](i, j) + d[static_cast<std::size_t>(j)](i, k) -
                    d[static_cast<std::size_t>(i)](j, k)) *
                   velocity[k];
    }
  return c;
}

Joints Arm::gravity(const Pose& pose) const noexcept {
  return {0, upper_weight * pose.c2, fore_weight * pose.s3};
}

double Arm::energy(const Pose& pose, const Joints& velocity) const noexcept {
  return 0.5 * velocity.dot(mass(pose) * velocity) + upper_weight * pose.s2 - fore_weight * pose.c3;
}

Eigen::Matrix3d apparent_mass(const Arm& arm, const Pose& pose) noexcept {
  const Eigen::Matrix3d j = arm.jacobian(pose);
  return (j * arm.mass(pose).inverse() * j.transpose()).inverse();
}

Eigen::Vector3d turned_to_law(const Eigen::Vector3d& in_arm) noexcept {
  return {in_arm.x(), -in_arm.z(), in_arm.y()};
}

Eigen::Vector3d turned_to_arm(const Eigen::Vector3d& in_law) noexcept {
  return {in_law.x(), in_law.z(), -in_law.y()};
}

}  // namespace forceshade::device
