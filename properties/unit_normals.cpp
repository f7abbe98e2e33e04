// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/unit_normals.h"

#include <cmath>
#include <cstdio>

#include "forceshade/properties/binary32.h"

namespace forceshade::properties {

Violation unit_normals(const Subject& subject, const Eigen::Vector3f& position) {
  if (subject.law.round_to_binary32(position).status == Status::invalid) return std::nullopt;
  const reference::Law::Estimate exact = subject.law.estimate(position);
  const Eigen::Vector3f force = subject.renderer(position).force;

  long double z = force.z();
  const bool is_sum = exact.facet == reference::Facet::cylinder_and_plane ||
                      (subject.law.id() == LawId::bump_cylinder && exact.facet == reference::Facet::axis);
  if (is_sum) z -= subject.law.geometry().K.mid() * -static_cast<long double>(position.z());
  const long double length = std::hypot(static_cast<long double>(force.x()), static_cast<long double>(force.y()), z);
  const long double magnitude = exact.force.magnitude.mid();
  const long double rounding = std::hypot(half_spacing(force.x()), half_spacing(force.z())) + exact.force.magnitude.rad() +
                               0x1p-60L * (length + std::fabs(static_cast<long double>(force.z())));
  if (std::fabs(length - magnitude) <= rounding) return std::nullopt;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "expected %.17Lg N within %.3Lg N, got %.17Lg N", magnitude, rounding, length);
  return "at " + show(position) + " mm the force's length is not the law's magnitude: " + numbers;
}

}  // namespace forceshade::properties
