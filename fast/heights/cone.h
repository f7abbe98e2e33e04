// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cone: U = height·(1 - ρ/radius) for ρ < radius, else 0; at the apex ∇U = (-height/radius, 0).

#include "forceshade/fast/heights/jet.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::Cone& cone, const Place& at) noexcept {
  const N height = N::exactly(static_cast<double>(cone.height)), radius = N::exactly(static_cast<double>(cone.radius));
  const N fall = height / radius;
  const N X = difference<N>(at.x(), cone.x), Y = difference<N>(at.y(), cone.y);
  if (at.x() == static_cast<double>(cone.x) && at.y() == static_cast<double>(cone.y)) return {height, -fall, N::exactly(0)};
  const N rho_squared = X * X + Y * Y;
  const N inside = radius * radius - rho_squared;
  switch (side_of_rim(inside, at.x() < static_cast<double>(cone.x))) {
    case Side::outside: return flat<N>();
    case Side::unknown: return undecided<N>();
    case Side::inside: break;
  }
  // radius - ρ as (radius² - ρ²)/(radius + ρ): no cancellation near the rim.
  const N rho = square_root(rho_squared), steepness = -(fall / rho);
  return {fall * (inside / (radius + rho)), steepness * X, steepness * Y};
}

}  // namespace forceshade::fast
