// SPDX-License-Identifier: BSD-3-Clause
#include "properties/work.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "properties/binary32.h"
#include "reference/estimates.h"

namespace forceshade::properties {
namespace {

// The places on the edge from a to b, as fractions, where the force may kink or jump: vertical lines, plane, polygonal faces,
// circle. Near the cylinder's axis the pieces shrink towards it, for there the force turns quickly.
std::vector<double> cuts(const LawClaims& claims, const PathPoint& a, const PathPoint& b) {
  std::vector<double> at{0, 1};
  const double dx = b.x - a.x, dz = b.z - a.z;
  const auto add = [&](double t) {
    if (t > 0 && t < 1) at.push_back(t);
  };
  const auto cross = [&](double from, double to) { add(from / (from - to)); };  // zero of a linear function

  for (const JumpLine& line : claims.jump_lines) {
    const auto x = static_cast<double>(line.x);
    cross(a.x - x, b.x - x);
    cross(a.x + x, b.x + x);
  }
  cross(a.z, b.z);
  cross(a.z - static_cast<double>(claims.h_prime), b.z - static_cast<double>(claims.h_prime));
  const auto g = static_cast<double>(claims.steepest), half = static_cast<double>(claims.w / 2);
  for (const double side : {-g, g}) cross(a.z + side * a.x - g * half, b.z + side * b.x - g * half);
  if (claims.w_prime > 0)
    for (const double top : {-0.5, 0.5}) {
      const double x = top * static_cast<double>(claims.w_prime);
      cross(a.x - x, b.x - x);
    }
  cross(a.x, b.x);

  if (claims.has_cylinder() && dx * dx + dz * dz > 0) {
    const auto R = static_cast<double>(claims.R);
    const double az = a.z + static_cast<double>(claims.d);
    const double length = std::hypot(dx, dz);
    const double middle = -(a.x * dx + az * dz) / (length * length);
    const double nearest = std::hypot(a.x + middle * dx, az + middle * dz);
    add(middle);
    for (double step = std::max(nearest, 1e-6 * R); step < 4 * R; step *= 2) {
      add(middle - step / length);
      add(middle + step / length);
    }
    if (nearest < R) {
      const double reach = std::sqrt((R - nearest) * (R + nearest)) / length;
      add(middle - reach);
      add(middle + reach);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

void Work::add(const Eigen::Vector3f& force, const Eigen::Matrix<long double, 3, 1>& exact_force, const Eigen::Vector3d& step) {
  rendered += force.cast<double>().dot(step);
  exact += static_cast<double>(exact_force.dot(step.cast<long double>()));
  turnover += force.cast<double>().norm() * step.norm();
  for (const int axis : {0, 1, 2}) rounding += half_spacing(force[axis]) * std::fabs(step[axis]);
}

Work work_around(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  const auto K = static_cast<double>(claims.K), R = static_cast<double>(claims.R), d = static_cast<double>(claims.d);
  Work work;
  const auto visit = [&](const PathPoint& a, const PathPoint& b, double t, double weight) {
    const double dx = b.x - a.x, dz = b.z - a.z;
    const Eigen::Vector3f position(static_cast<float>(a.x + t * dx), 0, static_cast<float>(a.z + t * dz));
    const auto exact = rendered.law.estimate(position).force;
    work.add(rendered.force_at(position).force, {exact.x.mid(), 0, exact.z.mid()}, weight * Eigen::Vector3d(dx, 0, dz));
    const double off = std::hypot(half_spacing(position.x()), half_spacing(position.z()));
    const double rho =
        claims.has_cylinder() ? std::hypot(static_cast<double>(position.x()), static_cast<double>(position.z()) + d) : 0;
    const double rate = K * (claims.has_cylinder() ? 1 + std::max(1.0, R / std::max(rho, 1e-9) - 1) : 1);
    work.placing += weight * rate * off * std::hypot(dx, dz);
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const PathPoint& a = vertices[i];
    const PathPoint& b = vertices[(i + 1) % vertices.size()];
    const std::vector<double> at = cuts(claims, a, b);
    for (std::size_t piece = 0; piece + 1 < at.size(); ++piece) {
      const double middle = 0.5 * (at[piece] + at[piece + 1]), half = 0.5 * (at[piece + 1] - at[piece]);
      if (!(half > 0)) continue;
      for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
        const double offset = half * Rule::abscissa()[k], weight = half * Rule::weights()[k];
        visit(a, b, middle + offset, weight);
        if (offset != 0) visit(a, b, middle - offset, weight);
      }
    }
  }
  return work;
}

}  // namespace forceshade::properties
