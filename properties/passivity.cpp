// SPDX-License-Identifier: BSD-3-Clause
#include "properties/passivity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reference/energy.h"
#include "text/number_text.h"

namespace forceshade::properties {
namespace {

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

}  // namespace

Violation passivity(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices) {
  const Work work = work_around(rendered, claims, vertices);
  const double allowed = (claims.is_conservative ? work.placing : work.exact) + work.rounding + work.summing();
  if (work.rendered <= allowed) return std::nullopt;
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "gives %.9g mJ to the hand; the exact law gives %.9g mJ and rounding may add %.3g mJ",
                work.rendered, claims.is_conservative ? 0.0 : work.exact, work.rounding);
  return "the closed path " + loop_text(vertices) + " mm " + numbers;
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
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "expected %.6g mJ within %.2g mJ, got %.6g mJ; the bound is %.6g mJ", loop.given_mJ,
                allowed, work.rendered, loop.bound_mJ[1]);
  return "the loop of depth " + std::to_string(depth) + " mm that should give most: " + numbers;
}

}  // namespace forceshade::properties
