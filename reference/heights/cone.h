// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cone: U = height·(1 - ρ/radius) for ρ < radius, else 0; at the apex ∇U = (-height/radius, 0).

#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {

// At a distance from the apex in a direction of length 1.
template <class N>
Jet<N> ray_jet(const height::Cone& cone, const N& rho, const N& direction_x, const N& direction_y) {
  const N height(static_cast<double>(cone.height)), radius(static_cast<double>(cone.radius));
  const N fall = height / radius;
  return {height - fall * rho, -fall * direction_x, -fall * direction_y};
}

// Inside the rim, off the apex; x, y: from the centre.
template <class N>
Jet<N> slope_jet(const height::Cone& cone, const N& x, const N& y) {
  const N rho = sqrt(N(square(x) + square(y)));
  return ray_jet(cone, rho, N(x / rho), N(y / rho));
}

template <class N>
Jet<N> jet(const height::Cone& cone, const Point2& at) {
  const auto exact_x = from_centre<Rational>(at.x, cone.x), exact_y = from_centre<Rational>(at.y, cone.y);
  if (!is_inside(exact_x, exact_y, Rational(static_cast<double>(cone.radius)))) return Jet<N>::flat();
  if (sign(exact_x) == 0 && sign(exact_y) == 0) return ray_jet(cone, N(0.0), N(1.0), N(0.0));
  return slope_jet(cone, from_centre<N>(at.x, cone.x), from_centre<N>(at.y, cone.y));
}

}  // namespace forceshade::reference
