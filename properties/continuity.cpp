// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/continuity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forceshade/properties/binary32.h"

namespace forceshade::properties {
namespace {

using Real = long double;

// The law reads a coordinate below a picometre as 0, so that is where such a position is.
Real placed(float coordinate) {
  return std::fabs(coordinate) < 0x1p-30F ? 0 : static_cast<Real>(coordinate);
}

Real magnitude(const reference::Law& law, const Eigen::Vector3f& position) {
  const auto force = law.estimate(position).force;
  return force.magnitude.mid();
}

// Whether a line separates a from b, the line itself belonging to the side that <= gives it: |x| <= line inside.
bool separates(Real line, Real a, Real b) {
  if (line == 0) return (a < 0) != (b < 0);
  const auto inside = [&](Real x) { return std::fabs(x) <= line; };
  return inside(a) != inside(b) || (!inside(a) && !inside(b) && (a < 0) != (b < 0));
}

// The angle through which the shaded normal turns between a and b; 0 on the plane beside the bump.
Real turn(const Shape& shape, Real a, Real b) {
  const auto slope = [&](Real x) {
    return std::fabs(x) <= shape.w / 2 ? std::asin(std::clamp(x / shape.R, Real(-1), Real(1))) : 0;
  };
  return std::fabs(slope(a) - slope(b));
}

}  // namespace

AllowedChange allowed_change(const reference::Law& law, const Shape& shape, const Eigen::Vector3f& a,
                             const Eigen::Vector3f& b) {
  const Real ax = placed(a.x()), bx = placed(b.x()), az = placed(a.z()), bz = placed(b.z());
  const Real apart = std::hypot(ax - bx, az - bz);
  const Real size = std::max(magnitude(law, a), magnitude(law, b));

  AllowedChange allowed{0, 0, true};
  int lines = 0;
  for (const JumpLine& line : shape.jump_lines) {
    if (!separates(line.x, ax, bx)) continue;
    ++lines;
    allowed.jump = 2 * shape.K * std::max(Real(0), line.height - az) * std::sin(line.angle / 2);
  }
  allowed.tells = lines <= 1;

  // How fast the force changes where it does not jump. A face or the plane: K·√(1 + slope²). The shaded normal turns on
  // top of that. The cylinder: K along the radius, K(R - ρ)/ρ across it. bump-cylinder adds the wall's K.
  allowed.reach = shape.K * std::sqrt(1 + shape.steepest * shape.steepest) * apart;
  if (shape.is_shaded() && lines == 0) allowed.reach += size * 2 * std::sin(turn(shape, ax, bx) / 2);
  if (lines > 0) allowed.reach *= 3;  // the listed size is taken at a's z and on the line itself
  if (lines > 0 && shape.is_shaded())
    allowed.reach +=
        size * 2 * std::sin(std::min(turn(shape, ax, shape.w / 2), turn(shape, bx, shape.w / 2)) / 2 + 2 * apart / shape.R);
  if (shape.has_cylinder()) {
    const Real rho_a = std::hypot(ax, az + shape.d), rho_b = std::hypot(bx, bz + shape.d);
    const Real nearest = std::min(rho_a, rho_b) - apart;
    if (nearest <= apart) {
      // Past the axis: from one side to the other the force turns round; only opposite sides have a listed size.
      const Real across = (ax * bx + (az + shape.d) * (bz + shape.d)) / (rho_a * rho_b);
      allowed.tells = across < -1 + Real(1e-9);
      allowed.jump = 2 * shape.K * shape.R;
      allowed.reach = shape.K * (rho_a + rho_b) + shape.K * shape.R * Real(1e-4);
    } else {
      allowed.reach = shape.K * std::max(Real(1), shape.R / nearest - 1) * apart;
    }
    if (shape.id == LawId::bump_cylinder) allowed.reach += shape.K * apart;
  }
  return allowed;
}

Violation continuity(const Subject& subject, const Shape& shape, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const AllowedChange allowed = allowed_change(subject.law, shape, a, b);
  if (!allowed.tells) return std::nullopt;
  const Eigen::Vector3f at_a = subject.renderer(a).force;
  const Eigen::Vector3f at_b = subject.renderer(b).force;
  const Real change = std::hypot(static_cast<Real>(at_a.x()) - static_cast<Real>(at_b.x()),
                                 static_cast<Real>(at_a.z()) - static_cast<Real>(at_b.z()));
  const Real rounding =
      std::hypot(half_spacing(at_a.x()), half_spacing(at_a.z())) + std::hypot(half_spacing(at_b.x()), half_spacing(at_b.z()));
  const Real reach = (allowed.reach + rounding) * (1 + Real(1e-12)) + Real(0x1p-50) * change;
  if (std::fabs(change - allowed.jump) <= reach) return std::nullopt;
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "the force changes by %.9Lg N; expected %.9Lg N within %.3Lg N", change, allowed.jump,
                reach);
  return "between " + show(a) + " and " + show(b) + " mm " + numbers;
}

}  // namespace forceshade::properties
