// SPDX-License-Identifier: BSD-3-Clause
#include "properties/height_properties.h"

#include <algorithm>
#include <cmath>

#include "properties/binary32.h"
#include "reference/estimates.h"
#include "text/formatted.h"
#include "text/joined.h"

namespace forceshade::properties {
namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Exact = reference::HeightMapField::Estimate;

// Relative: how good the rates at which gradients turn are (height_map_claims.cpp, binary64). R² - ρ² of a cap cancels 23 bits
// where its width is the binary32 next to 2R, and its power 3/2 makes 1.5 of that: 2^-29.4. Everything else is good to 2^-45.
constexpr double kRates = 0x1p-29;

// A coordinate below a picometre is read as 0, so that is where such a position is.
Vector placed(const Eigen::Vector3f& position) {
  return position.unaryExpr([](float c) { return std::fabs(c) < 0x1p-30F ? 0.0F : c; }).cast<Real>();
}

Real rounding(const Eigen::Vector3f& force) {
  return std::hypot(half_spacing(force.x()), half_spacing(force.y()), half_spacing(force.z()));
}

// The direction of the force: a unit normal, or, where the map is conservative, a vector that is longer where it is steeper.
Vector direction(const HeightMapClaims& claims, const Exact& exact) {
  const Vector normal(-exact.Ux.mid(), -exact.Uy.mid(), 1);
  return claims.mode == height::Mode::conservative ? normal : normal.normalized();
}

Vector force_of(const Exact& exact) {
  if (!(exact.gap.mid() > 0)) return Vector::Zero();
  return {exact.x.mid(), exact.y.mid(), exact.z.mid()};
}

Real magnitude(const HeightMapClaims& claims, const Exact& exact) {
  return static_cast<Real>(claims.stiffness) * std::max(Real(0), exact.gap.mid());
}

// The most that the magnitude's part of the force may change on a way of `apart` mm where the surface that depth is measured
// from is nowhere steeper, N.
Real change_of_magnitude(const HeightMapClaims& claims, Real apart, Real steepest) {
  const Real slope = std::hypot(Real(1), steepest);
  const Real longest = claims.mode == height::Mode::conservative ? slope : 1;
  return static_cast<Real>(claims.stiffness) * slope * apart * longest;
}

GradientChange gradient_change_between(const HeightMapClaims& claims, const Vector& a, const Vector& b) {
  const auto middle = static_cast<Eigen::Vector3d>((0.5L * (a + b)).cast<double>());
  return claims.gradient_change(middle.x(), middle.y(), static_cast<double>((a - b).head<2>().norm()));
}

std::string between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return "between " + show(a) + " and " + show(b) + " mm ";
}

}  // namespace

Violation continuity(const RenderedHeightMap& rendered, const HeightMapClaims& claims, const Eigen::Vector3f& a,
                     const Eigen::Vector3f& b) {
  const Exact exact_a = rendered.law.estimate(a), exact_b = rendered.law.estimate(b);
  const Vector at_a = placed(a), at_b = placed(b);
  const Real apart = (at_a - at_b).norm(), size = std::max(magnitude(claims, exact_a), magnitude(claims, exact_b));
  const GradientChange change_of_gradient = gradient_change_between(claims, at_a, at_b);
  const Eigen::Vector3f force_a = rendered.force_at(a).force, force_b = rendered.force_at(b).force;
  const Real change = (force_a.cast<Real>() - force_b.cast<Real>()).norm();

  const Real jump = change_of_gradient.kink ? size * (direction(claims, exact_a) - direction(claims, exact_b)).norm() : 0;
  const Real turning =
      change_of_gradient.kink ? 0 : size * static_cast<Real>(change_of_gradient.rate) * (at_a - at_b).head<2>().norm();
  const Real reach = (change_of_magnitude(claims, apart, static_cast<Real>(claims.steepest_surface)) + turning +
                      rounding(force_a) + rounding(force_b)) *
                     (1 + static_cast<Real>(kRates));
  if (std::fabs(change - jump) <= reach) return std::nullopt;
  return between(a, b) + formatted("the force changes by %.9Lg N; expected %.9Lg N within %.3Lg N", change, jump, reach);
}

Violation gradient_across_cells(const RenderedHeightMap& rendered, const HeightMapClaims& claims, const Eigen::Vector3f& a,
                                const Eigen::Vector3f& b) {
  const Vector at_a = placed(a), at_b = placed(b);
  const auto apart = static_cast<double>((at_a - at_b).head<2>().norm());
  const auto x = static_cast<double>(at_a.x()), y = static_cast<double>(at_a.y());
  double rate = 0;
  std::string line;
  for (std::size_t i = 0; i < claims.map_parts; ++i) {
    const PartShape& part = claims.parts[i];
    const GradientChange change_of_gradient = part.gradient_change(x, y, apart);
    rate += change_of_gradient.rate;
    if (!part.columns) {
      if (change_of_gradient.kink) return std::nullopt;
      continue;
    }
    const bool is_column = part.columns->distance(x) <= part.rows->distance(y);
    line = std::string("across a cell line at ") + (is_column ? "x = " + show(a.x()) : "y = " + show(a.y())) + " mm of part " +
           std::to_string(i + 1) + ", ";
  }
  const Eigen::Vector3f force_a = rendered.force_at(a).force, force_b = rendered.force_at(b).force;
  const auto is_felt = [](const Eigen::Vector3f& force) { return static_cast<Real>(force.z()) > rounding(force); };
  if (!is_felt(force_a) || !is_felt(force_b)) return std::nullopt;
  const auto felt = [](const Eigen::Vector3f& force) {
    return Eigen::Vector2d(-force.cast<double>().head<2>() / static_cast<double>(force.z()));
  };
  const auto error = [&](const Eigen::Vector3f& force) {
    // (F_x + δ)/(F_z + ε) - F_x/F_z = (δ - ε·F_x/F_z)/(F_z + ε), δ and ε no larger than r.
    const auto r = static_cast<double>(rounding(force));
    return r / (static_cast<double>(force.z()) - r) * (1 + felt(force).norm());
  };
  const double jump = (felt(force_a) - felt(force_b)).norm();
  const double allowed = (rate * apart + error(force_a) + error(force_b)) * (1 + kRates);
  if (jump <= allowed) return std::nullopt;
  return between(a, b) + line +
         formatted("the gradient jumps by %.6g; a continuous one changes by %.3g at most", jump, allowed);
}

Violation passivity(const RenderedHeightMap& rendered, const HeightMapClaims& claims,
                    const std::vector<Eigen::Vector3f>& corners) {
  constexpr int kPieces = 24;  // of each edge, each taken at its middle
  Work work;
  Real quadrature = 0;  // mJ: how far that may be from the exact law's work
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d from = corners[i].cast<double>(), to = corners[(i + 1) % corners.size()].cast<double>();
    const Eigen::Vector3d step = (to - from) / kPieces;
    for (int piece = 0; piece < kPieces; ++piece) {
      const Eigen::Vector3f middle = (from + (piece + 0.5) * step).cast<float>();
      const Exact exact = rendered.law.estimate(middle);
      work.add(rendered.force_at(middle).force, force_of(exact), step);
      if (!claims.is_conservative) continue;
      // No position of the piece is farther than this from where the force was taken, rounded to binary32.
      const Real length = step.norm(), far = length / 2 + rounding(middle);
      const GradientChange change_of_gradient =
          claims.gradient_change(static_cast<double>(middle.x()), static_cast<double>(middle.y()), static_cast<double>(far));
      const Real rate = static_cast<Real>(change_of_gradient.rate) * far, global = static_cast<Real>(claims.steepest);
      const Real steepest =
          change_of_gradient.kink ? global : std::min(global, std::hypot(exact.Ux.mid(), exact.Uy.mid()) + rate);
      const Real change = change_of_magnitude(claims, far, steepest);
      quadrature += length * (change + (magnitude(claims, exact) + change) * (change_of_gradient.kink ? 2 * global : rate));
    }
  }
  const double slack = work.rounding + work.summing();
  const bool gives = work.rendered > work.exact + slack;
  const bool gives_though_conservative = claims.is_conservative && work.rendered > static_cast<double>(quadrature) + slack;
  if (!gives && !gives_though_conservative) return std::nullopt;
  return "the closed path " + joined(corners, ", ", [](const Eigen::Vector3f& corner) { return show(corner); }) + " mm " +
         formatted("gives %.9g mJ to the hand; the exact law gives %.9g mJ and rounding may add %.3g mJ", work.rendered,
                   gives ? work.exact : static_cast<double>(quadrature), work.rounding);
}

}  // namespace forceshade::properties
