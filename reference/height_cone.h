// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cone: U = height·(1 - ρ/radius) for ρ < radius, else 0; at the apex ∇U = (-height/radius, 0).

#include "forceshade/reference/height_jet.h"

namespace forceshade::reference {

template <class N>
Jet<N> jet(const height::Cone& cone, const Point2& at) {
  const auto exact_x = from_centre<Rational>(at.x, cone.x), exact_y = from_centre<Rational>(at.y, cone.y);
  if (!is_inside(exact_x, exact_y, Rational(static_cast<double>(cone.radius)))) return Jet<N>::flat();
  const N height(static_cast<double>(cone.height)), radius(static_cast<double>(cone.radius));
  const N fall = height / radius;
  if (sign(exact_x) == 0 && sign(exact_y) == 0) return {height, -fall, N(0.0)};
  const N x = from_centre<N>(at.x, cone.x), y = from_centre<N>(at.y, cone.y);
  const N rho = sqrt(N(x * x + y * y));
  return {height - fall * rho, -(fall * x) / rho, -(fall * y) / rho};
}

}  // namespace forceshade::reference
