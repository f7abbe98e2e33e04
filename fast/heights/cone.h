// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cone: U = height·(1 - ρ/radius) for ρ < radius, else 0; at the apex ∇U = (-height/radius, 0).

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"

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

inline MaybeError error_of(const height::Cone& c) noexcept {
  using namespace height_limits;
  return first_outside(
      {centre_x(c.x), centre_y(c.y), height_of(c.height), {"radius", "mm", c.radius, kSmallestReach, kLargestReach}});
}

// height - fall·ρ, with the gradient -fall·(X, Y)·ρ/ρ².
inline void add_terms(const height::Cone& cone, const Place& at, ExactTerms& terms) noexcept {
  const Fraction height = Fraction::exactly(static_cast<double>(cone.height)),
                 radius = Fraction::exactly(static_cast<double>(cone.radius));
  const Fraction fall = height / radius, X = difference<Fraction>(at.x(), cone.x), Y = difference<Fraction>(at.y(), cone.y);
  const Fraction rho_squared = X * X + Y * Y;
  if (rho_squared.is_zero()) return terms.add_rational({height, -fall, {}});
  if (side_of_rim(radius * radius - rho_squared, sign(X) == Sign::negative) != Side::inside) return;
  terms.add_rational({height, {}, {}});
  terms.add_root(rho_squared, {-fall, -fall * X, -fall * Y});
}
inline DenominatorBits denominator_bits(const height::Cone& cone) noexcept {
  return {odd_bits(cone.radius), odd_bits(cone.radius), true};
}

}  // namespace forceshade::fast
