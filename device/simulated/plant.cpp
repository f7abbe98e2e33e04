// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/plant.h"

#include <Eigen/LU>
#include <algorithm>

namespace forceshade::device {
namespace {

struct Rates {
  Joints velocity, acceleration;
  Eigen::Vector3d hand_velocity, hand_acceleration;
};

// A position on the way and the velocity there.
struct Point {
  Eigen::Vector3d position, velocity;
};

Point point_of(const HermiteStep& way, double period, double s) noexcept {
  const double u = 1 - s;
  const Eigen::Vector3d rise = way.to - way.from;
  return {way.from + s * s * (3 - 2 * s) * rise + period * s * u * (u * way.from_velocity - s * way.to_velocity),
          6 * s * u / period * rise + u * (1 - 3 * s) * way.from_velocity + s * (3 * s - 2) * way.to_velocity};
}

Motion moved(const Motion& m, const Rates& r, double h) noexcept {
  return {m.angles + h * r.velocity, m.velocity + h * r.acceleration, m.hand + h * r.hand_velocity,
          m.hand_velocity + h * r.hand_acceleration};
}

// All torque but Coulomb friction's, inertial torque included, and how the hand's mass is pulled.
struct Pull {
  Joints torque;
  Eigen::Vector3d hand_acceleration{0, 0, 0};
};

Pull pull_on(const Plant& plant, const Motion& m, const Pose& pose, const Joints& torque, const Point& meant) noexcept {
  const Arm& arm = plant.arm;
  Pull pull{torque - arm.coriolis(pose, m.velocity) * m.velocity - arm.gravity(pose) - plant.viscous.cwiseProduct(m.velocity)};
  if (!plant.grip) return pull;
  const Grip& g = *plant.grip;
  const Eigen::Matrix3d jacobian = arm.jacobian(pose);
  const Eigen::Vector3d on_tip =
      g.flesh_stiffness * (m.hand - arm.forward(pose)) + g.flesh_damping * (m.hand_velocity - jacobian * m.velocity);
  pull.torque += jacobian.transpose() * on_tip;
  pull.hand_acceleration =
      (g.arm_stiffness * (meant.position - m.hand) + g.arm_damping * (meant.velocity - m.hand_velocity) - on_tip) / g.mass;
  return pull;
}

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

Motion Plant::advanced(Motion m, const Joints& torque, const HermiteStep& way, double period, int steps) const noexcept {
  const double h = period / steps;
  Point end = point_of(way, period, 0);
  Pose pose = m.angles;
  for (int k = 0; k < steps; ++k) {
    const Point begin = end, middle = point_of(way, period, (k + 0.5) / steps);
    end = point_of(way, period, static_cast<double>(k + 1) / steps);
    const Eigen::Matrix3d mass = arm.mass(pose);
    const Pull pull = pull_on(*this, m, pose, torque, begin);
    const Slip slip = slip_of(mass, pull.torque, m.velocity, coulomb);
    const auto rates_by = [&](const Motion& at, const Eigen::Matrix3d& its_mass, const Pull& its_pull) -> Rates {
      return {at.velocity, acceleration(its_mass, its_pull.torque, slip, coulomb), at.hand_velocity,
              its_pull.hand_acceleration};
    };
    const auto rates = [&](const Motion& at, const Point& meant) {
      const Pose there = at.angles;
      return rates_by(at, arm.mass(there), pull_on(*this, at, there, torque, meant));
    };
    const Rates a = rates_by(m, mass, pull), b = rates(moved(m, a, h / 2), middle), c = rates(moved(m, b, h / 2), middle),
                d = rates(moved(m, c, h), end);
    m.angles += h / 6 * (a.velocity + 2 * (b.velocity + c.velocity) + d.velocity);
    m.velocity += h / 6 * (a.acceleration + 2 * (b.acceleration + c.acceleration) + d.acceleration);
    m.hand += h / 6 * (a.hand_velocity + 2 * (b.hand_velocity + c.hand_velocity) + d.hand_velocity);
    m.hand_velocity += h / 6 * (a.hand_acceleration + 2 * (b.hand_acceleration + c.hand_acceleration) + d.hand_acceleration);
    pose = m.angles;
    m.velocity = stopped_where_reversed(arm.mass(pose), m.velocity, slip, coulomb);
  }
  return m;
}

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
