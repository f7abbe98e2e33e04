// SPDX-License-Identifier: BSD-3-Clause
#include "properties/continuity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "properties/binary32.h"
#include "reference/estimates.h"

namespace forceshade::properties {
namespace {

using Real = long double;

// Relative: numbers of 2^-60 or better (long double) go through some dozen operations of 2^-64 and library functions of one
// unit in the last place.
constexpr Real kEvaluation = 0x1p-50L;
// Positions are on opposite sides of the axis if 1 + the cosine of the angle between them is below this. The angle that is
// left, at most 4.5e-5 rad, is allowed for; a larger one would allow for more than there is to see.
constexpr Real kOpposite = 1e-9L;

// The law reads a coordinate below a picometre as 0, so that is where such a position is.
Real placed(float coordinate) {
  return std::fabs(coordinate) < 0x1p-30F ? 0 : static_cast<Real>(coordinate);
}

Real magnitude(const reference::Law& law, const Eigen::Vector3f& position) {
  const auto force = law.estimate(position).force;
  return force.magnitude.mid();
}

// True if a line separates a from b, the line itself belonging to the side that <= gives it: |x| <= line inside.
bool separates(Real line, Real a, Real b) {
  if (line == 0) return (a < 0) != (b < 0);
  const auto inside = [&](Real x) { return std::fabs(x) <= line; };
  return inside(a) != inside(b) || (!inside(a) && !inside(b) && (a < 0) != (b < 0));
}

// The angle through which the shaded normal turns between a and b; 0 on the plane beside the bump.
Real turn(const LawClaims& claims, Real a, Real b) {
  const auto slope = [&](Real x) {
    return std::fabs(x) <= claims.w / 2 ? std::asin(std::clamp(x / claims.R, Real(-1), Real(1))) : 0;
  };
  return std::fabs(slope(a) - slope(b));
}

}  // namespace

AllowedChange allowed_change(const reference::Law& law, const LawClaims& claims, const Eigen::Vector3f& a,
                             const Eigen::Vector3f& b) {
  const Real ax = placed(a.x()), bx = placed(b.x()), az = placed(a.z()), bz = placed(b.z());
  const Real apart = std::hypot(ax - bx, az - bz);
  const Real size = std::max(magnitude(law, a), magnitude(law, b));

  AllowedChange allowed{0, 0, true};
  int lines = 0;
  for (const JumpLine& line : claims.jump_lines) {
    if (!separates(line.x, ax, bx)) continue;
    ++lines;
    allowed.jump = 2 * claims.K * std::max(Real(0), line.height - az) * std::sin(line.angle / 2);
  }
  allowed.is_known = lines <= 1;

  // The rate of the force's change where it does not jump. A face or the plane: K·√(1 + slope²). The shaded normal turns on
  // top of that. The cylinder: K along the radius, K(R - ρ)/ρ across it. bump-cylinder adds the wall's K.
  //
  // Across a line x = L the listed size is that at (L, az), which is |ax - L| from a and at most |bx - L| + |az - bz| from b:
  // together |ax - bx| + |az - bz|, on the two sides, on each of which nothing jumps.
  const Real rate = claims.K * std::sqrt(1 + claims.steepest * claims.steepest);
  allowed.reach = rate * (lines == 0 ? apart : std::fabs(ax - bx) + std::fabs(az - bz));
  if (claims.is_shaded()) {
    // The one of a and b that is inside the bump: its normal turns on the way to the line; that of the plane outside does not.
    const auto to_the_edge = [&](Real x) { return turn(claims, std::fabs(x), claims.w / 2); };
    const Real turned = lines == 0 ? turn(claims, ax, bx) : std::min(to_the_edge(ax), to_the_edge(bx));
    allowed.reach += size * (2 * std::sin(turned / 2) + kEvaluation);  // the slopes' difference cancels, and is as good as that
  }
  if (claims.has_cylinder()) {
    const Real rho_a = std::hypot(ax, az + claims.d), rho_b = std::hypot(bx, bz + claims.d);
    const Real nearest = std::min(rho_a, rho_b) - apart;
    if (nearest <= apart) {
      // Past the axis: from one side to the other the force turns round; only opposite sides have a listed size.
      // With u and v the directions from the axis, F = K(R - ρ)u at a, K(R - ρ)v at b: their difference is 2KR less K times
      // both ρ, as far as v is -u, and off by KR|u + v| at most where it is not.
      const Real across = (ax * bx + (az + claims.d) * (bz + claims.d)) / (rho_a * rho_b);
      const Real skew = std::hypot(ax / rho_a + bx / rho_b, (az + claims.d) / rho_a + (bz + claims.d) / rho_b);
      allowed.is_known = across < -1 + kOpposite;
      allowed.jump = 2 * claims.K * claims.R;
      allowed.reach = claims.K * (rho_a + rho_b + claims.R * (skew + kEvaluation));
    } else {
      allowed.reach = claims.K * std::max(Real(1), claims.R / nearest - 1) * apart;
    }
    if (claims.id == LawId::bump_cylinder) allowed.reach += claims.K * apart;
  }
  return allowed;
}

Violation continuity(const RenderedLaw& rendered, const LawClaims& claims, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const AllowedChange allowed = allowed_change(rendered.law, claims, a, b);
  if (!allowed.is_known) return std::nullopt;
  const Eigen::Vector3f at_a = rendered.force_at(a).force;
  const Eigen::Vector3f at_b = rendered.force_at(b).force;
  const Real change = std::hypot(static_cast<Real>(at_a.x()) - static_cast<Real>(at_b.x()),
                                 static_cast<Real>(at_a.z()) - static_cast<Real>(at_b.z()));
  const Real rounding =
      std::hypot(half_spacing(at_a.x()), half_spacing(at_a.z())) + std::hypot(half_spacing(at_b.x()), half_spacing(at_b.z()));
  const Real reach = (allowed.reach + rounding) * (1 + kEvaluation) + kEvaluation * change;
  if (std::fabs(change - allowed.jump) <= reach) return std::nullopt;
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "the force changes by %.9Lg N; expected %.9Lg N within %.3Lg N", change, allowed.jump,
                reach);
  return "between " + show(a) + " and " + show(b) + " mm " + numbers;
}

}  // namespace forceshade::properties
