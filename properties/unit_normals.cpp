// SPDX-License-Identifier: BSD-3-Clause
#include "properties/unit_normals.h"

#include <cmath>
#include <cstdio>

#include "properties/binary32.h"
#include "properties/positions.h"
#include "reference/estimates.h"

namespace forceshade::properties {
namespace {

using Real = long double;

// exact: N, of the magnitude, with what is not known of it.
Violation difference_in_length(const Eigen::Vector3f& position, const Eigen::Vector3f& force, Real length,
                               const reference::Ball64& exact) {
  const Real rounding = std::hypot(half_spacing(force.x()), half_spacing(force.y()), half_spacing(force.z())) + exact.rad() +
                        0x1p-60L * (length + std::fabs(static_cast<Real>(force.z())));
  if (std::fabs(length - exact.mid()) <= rounding) return std::nullopt;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "expected %.17Lg N within %.3Lg N, got %.17Lg N", exact.mid(), rounding, length);
  return "at " + show(position) + " mm the force's length is not the law's magnitude: " + numbers;
}

}  // namespace

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

}  // namespace forceshade::properties
