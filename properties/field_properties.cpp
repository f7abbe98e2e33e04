// SPDX-License-Identifier: BSD-3-Clause
#include "properties/field_properties.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "properties/binary32.h"
#include "properties/positions.h"
#include "reference/energy.h"
#include "reference/estimates.h"
#include "rendering/breakdown.h"
#include "text/formatted.h"
#include "text/number_text.h"

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

// exact: N, of the magnitude, with what is not known of it.
Violation difference_in_length(const Eigen::Vector3f& position, const Eigen::Vector3f& force, Real length,
                               const reference::Ball64& exact) {
  const Real rounding = std::hypot(half_spacing(force.x()), half_spacing(force.y()), half_spacing(force.z())) + exact.rad() +
                        0x1p-60L * (length + std::fabs(static_cast<Real>(force.z())));
  if (std::fabs(length - exact.mid()) <= rounding) return std::nullopt;
  return "at " + show(position) + " mm the force's length is not the law's magnitude: " +
         formatted("expected %.17Lg N within %.3Lg N, got %.17Lg N", exact.mid(), rounding, length);
}

// On the pieces that work.cpp cuts, a conservative force is linear, or smooth with its nearest singularity, the axis, as far
// away as the piece is long: there 15 points of Gauss are good to 4.6^-30, far below what adding up loses.

// The force of a shaded bump whose edge is its cylinder's (w = 2R) has a vertical tangent at the edge; 15 points integrate the
// square root at the end of a piece to 6e-5 of it.
constexpr double kVerticalTangent = 1e-4;
// The least share of the bound that a witness gives: docs/energy.md ("The witness"), 99.7 % being the least that was found.
constexpr double kWitnessShare = 0.99;

std::string loop_text(const std::vector<PathPoint>& vertices) {
  std::string text;
  for (const PathPoint& v : vertices) text += (text.empty() ? "(" : " (") + hexfloat(v.x) + ", " + hexfloat(v.z) + ')';
  return text;
}

// A loop through the object that ends where nothing is felt.
std::vector<PathPoint> through(const LawClaims& claims, double depth) {
  if (!claims.has_cylinder()) return {{-5, -depth}, {5, -depth}, {3, 1}, {-4, 1}};
  const auto h = static_cast<double>(claims.h), w = static_cast<double>(claims.w);
  return {{-w / 4, h - depth}, {w / 4, h - depth}, {w / 8, h + 1}, {-w / 8, h + 1}};
}

// By the force at the middle of steps no longer than 1 µm.
double walked(const ForceAt& renderer, const std::vector<Eigen::Vector3f>& path, const Monitor& monitor) {
  double generated = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    monitor.at(static_cast<double>(i) / static_cast<double>(path.size()));
    const Eigen::Vector3d from = path[i - 1].cast<double>(), way = path[i].cast<double>() - from;
    const int steps = static_cast<int>(std::ceil(way.norm() * 1000));
    for (int k = 0; k < steps; ++k)
      generated += renderer((from + (k + 0.5) / steps * way).cast<float>()).force.cast<double>().dot(way) / steps;
  }
  return generated;
}

std::string_view word(Status status) {
  return kStatusNames[static_cast<std::size_t>(finished(status))];
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
  return "between " + show(a) + " and " + show(b) + " mm " +
         formatted("the force changes by %.9Lg N; expected %.9Lg N within %.3Lg N", change, allowed.jump, reach);
}

Violation unit_normals(const RenderedLaw& rendered, const Eigen::Vector3f& position) {
  if (rendered.law.round_to_binary32(position).status == Status::invalid) return std::nullopt;
  const reference::Law::Estimate exact = rendered.law.estimate(position);
  const Eigen::Vector3f force = rendered.force_at(position).force;

  Real z = force.z();
  const bool is_sum = exact.facet == reference::Facet::cylinder_and_plane ||
                      (rendered.law.id() == LawId::bump_cylinder && exact.facet == reference::Facet::axis);
  if (is_sum) z -= rendered.law.geometry().K.mid() * -static_cast<Real>(position.z());
  const Real length = std::hypot(static_cast<Real>(force.x()), static_cast<Real>(force.y()), z);
  return difference_in_length(position, force, length, exact.force.magnitude);
}

Violation unit_normals(const RenderedHeightMap& rendered, const Eigen::Vector3f& position) {
  const reference::HeightMapField& law = rendered.law;
  if (!is_valid(position)) return std::nullopt;
  const reference::HeightMapField::Estimate exact = law.estimate(position);
  const Eigen::Vector3f force = rendered.force_at(position).force;
  reference::Ball64 magnitude(0.0);
  if (exact.gap.mid() > 0) magnitude = reference::Ball64(static_cast<double>(law.stiffness())) * exact.gap;
  if (law.mode() == height::Mode::conservative)
    magnitude = magnitude * sqrt(exact.Ux * exact.Ux + exact.Uy * exact.Uy + reference::Ball64(1.0));
  const Real length = std::hypot(static_cast<Real>(force.x()), static_cast<Real>(force.y()), static_cast<Real>(force.z()));
  return difference_in_length(position, force, length, magnitude);
}

Violation passivity(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices) {
  const Work work = work_around(rendered, claims, vertices);
  const double allowed = (claims.is_conservative ? work.placing : work.exact) + work.rounding + work.summing();
  if (work.rendered <= allowed) return std::nullopt;
  return "the closed path " + loop_text(vertices) + " mm " +
         formatted("gives %.9g mJ to the hand; the exact law gives %.9g mJ and rounding may add %.3g mJ", work.rendered,
                   claims.is_conservative ? 0.0 : work.exact, work.rounding);
}

WitnessLoop witness_loop(const reference::Law& law, float depth) {
  const std::vector<reference::PathPoint> corners = reference::witness(law, depth);
  if (corners.empty()) return {through(LawClaims(law), static_cast<double>(depth)), {0, 0}, 0};
  WitnessLoop loop{{}, binary64(reference::loop_bound(law, depth).anywhere), binary64(reference::work(law, corners))[0]};
  // work_around() closes it.
  for (std::size_t i = 1; i < corners.size(); ++i)
    loop.vertices.push_back({static_cast<double>(corners[i].x), static_cast<double>(corners[i].z)});
  return loop;
}

Violation witness_is_reached(const RenderedLaw& rendered, const LawClaims& claims, float depth) {
  const WitnessLoop loop = witness_loop(rendered.law, depth);
  const Work work = work_around(rendered, claims, loop.vertices);
  const double allowed = work.rounding + work.placing + work.summing() + kVerticalTangent * loop.given_mJ;
  if (std::fabs(work.rendered - loop.given_mJ) <= allowed && loop.given_mJ >= kWitnessShare * loop.bound_mJ[1])
    return std::nullopt;
  return "the loop of depth " + shortest(depth) + " mm that should give most: " +
         formatted("expected %.6g mJ within %.2g mJ, got %.6g mJ; the bound is %.6g mJ", loop.given_mJ, allowed, work.rendered,
                   loop.bound_mJ[1]);
}

reference::Slice certified_slice(const HeightMap& map) {
  float reach = 12.7F;
  for (const auto* parts : {&map.parts, &map.surface})
    for (const height::Part& part : *parts)
      if (const auto* grid = std::get_if<std::shared_ptr<const height::Grid>>(&part.shape))
        reach = std::min(reach, 250 * (*grid)->pitch);
  return {reference::Slice::Along::x, 0, -reach, reach};
}

std::vector<LoopEnergy> loop_energies(const RenderedHeightMap& rendered, const Monitor& monitor) {
  const reference::HeightMapField& law = rendered.law;
  const reference::Slice slice = certified_slice(law.map());
  std::vector<LoopEnergy> energies;
  for (const auto& [depth, half] : {std::pair{0.5F, monitor.part(0, 0.5)}, {2.0F, monitor.part(0.5, 1)}}) {
    if (slice_error(law, slice, depth)) continue;
    const auto bound = loop_bound(law, slice, depth, half.part(0, 0.4));
    const auto loop = witness(law, slice, depth, half.part(0.4, 0.6));
    const auto generated = work(law, loop, half.part(0.6, 0.8));
    energies.push_back({static_cast<double>(depth), binary64(bound.most()), binary64(generated)[0],
                        walked(rendered.force_at, loop, half.part(0.8, 1))});
  }
  return energies;
}

std::string not_decided(const Eigen::Vector3f& position, const std::domain_error& error) {
  return "at " + show(position) + " mm the reference does not decide: " + error.what();
}

Violation difference(const Eigen::Vector3f& position, const Rendered& answer, const reference::Rounded& exact) {
  const bool same = same_bits(answer.force.x(), exact.force.x()) && same_bits(answer.force.y(), exact.force.y()) &&
                    same_bits(answer.force.z(), exact.force.z()) && finished(answer.status) == finished(exact.status);
  if (same) return std::nullopt;
  return "at " + show(position) + " mm: expected the force " + show(exact.force) + " N (" + std::string(word(exact.status)) +
         "), got " + show(answer.force) + " N (" + std::string(word(answer.status)) + ")";
}

}  // namespace forceshade::properties
