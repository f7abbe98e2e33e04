// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder cap and sphere cap: U = √(R² - ρ²) - √(R² - (w/2)²) for 2ρ < w, else 0; for the cylinder ρ = |X|.

#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {

// Inside the rim; x, y: from the centre.
template <class N>
Jet<N> cap_jet(float radius, float width, const N& x, const N& y) {
  const N R(static_cast<double>(radius)), half = N(static_cast<double>(width)) / N(2.0);
  const N above_axis = sqrt(N(R * R - square(x) - square(y)));
  return {above_axis - sqrt(N(R * R - half * half)), -x / above_axis, -y / above_axis};
}

template <class N>
Jet<N> ridge_jet(const height::CylinderCap& cap, const N& x) {
  Jet<N> ridge = cap_jet(cap.radius, cap.width, x, N(0.0));
  ridge.Uy = N(0.0);
  return ridge;
}

template <class N>
Jet<N> jet(const height::SphereCap& cap, const Point2& at) {
  const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
  if (!is_inside(from_centre<Rational>(at.x, cap.x), from_centre<Rational>(at.y, cap.y), half)) return Jet<N>::flat();
  return cap_jet(cap.radius, cap.width, from_centre<N>(at.x, cap.x), from_centre<N>(at.y, cap.y));
}

template <class N>
Jet<N> jet(const height::CylinderCap& cap, const Point2& at) {
  const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
  if (!is_inside(from_centre<Rational>(at.x, cap.x), Rational(0), half)) return Jet<N>::flat();
  return ridge_jet(cap, from_centre<N>(at.x, cap.x));
}

}  // namespace forceshade::reference
