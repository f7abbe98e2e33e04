// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/friction.h"

#include <Eigen/LU>
#include <algorithm>

namespace forceshade::device {
namespace {

using Held = Eigen::Array<bool, 3, 1>;

// x with x = 0 where held and (M x)_i = b_i elsewhere.
Joints solved(Eigen::Matrix3d mass, Joints b, const Held& held) noexcept {
  for (int i = 0; i < 3; ++i) {
    if (!held[i]) continue;
    mass.row(i).setZero();
    mass.col(i).setZero();
    mass(i, i) = 1;
    b[i] = 0;
  }
  Joints x = mass.inverse() * b;
  for (int i = 0; i < 3; ++i)
    if (held[i]) x[i] = 0;
  return x;
}

int sign(double x) noexcept {
  return x < 0 ? -1 : 1;
}

}  // namespace

Slip slip_of(const Eigen::Matrix3d& mass, const Joints& torque, const Joints& velocity, const Joints& coulomb) noexcept {
  if ((velocity.array() != 0).all())  // as most of the time
    return {sign(velocity[0]), sign(velocity[1]), sign(velocity[2])};
  const Eigen::Matrix3d mobility = mass.inverse();
  Joints friction = Joints::Zero();
  for (int i = 0; i < 3; ++i)
    if (velocity[i] != 0) friction[i] = -coulomb[i] * sign(velocity[i]);

  // Joint 1 is uncoupled and 2 and 3 weakly coupled: a handful of rounds settle; more would not change a decision that
  // rounding has not already made arbitrary. A round that changes nothing is the last: each further one would repeat it.
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    const Joints before = friction;
    for (int i = 0; i < 3; ++i) {
      if (velocity[i] != 0) continue;
      const double stopping = friction[i] - mobility.row(i).dot(torque + friction) / mobility(i, i);
      friction[i] = std::clamp(stopping, -coulomb[i], coulomb[i]);
    }
    if (friction == before) break;
  }

  Slip slip;
  for (int i = 0; i < 3; ++i) {
    const bool sticks = velocity[i] == 0 && std::abs(friction[i]) < coulomb[i];
    slip[i] = sticks ? 0 : velocity[i] != 0 ? sign(velocity[i]) : -sign(friction[i]);
  }
  return slip;
}

Joints acceleration(const Eigen::Matrix3d& mass, const Joints& torque, const Slip& slip, const Joints& coulomb) noexcept {
  return solved(mass, torque - coulomb.cwiseProduct(slip.cast<double>()), slip.array() == 0);
}

Joints stopped_where_reversed(const Eigen::Matrix3d& mass, const Joints& velocity, const Slip& slip,
                              const Joints& coulomb) noexcept {
  const Held reversed = velocity.array() * slip.cast<double>().array() < 0 && coulomb.array() > 0;
  if (!reversed.any()) return velocity;
  return solved(mass, mass * velocity, reversed || slip.array() == 0);
}

}  // namespace forceshade::device
