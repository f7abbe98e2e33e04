// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder cap and sphere cap: U = √(R² - ρ²) - √(R² - (w/2)²) for 2ρ < w, else 0; for the cylinder ρ = |X|.

#include "forceshade/fast/heights/jet.h"

namespace forceshade::fast {

template <class N>
Jet<N> cap_jet(float radius, float width, const N& X, const N& Y, bool is_left_of_centre) noexcept {
  const N R = N::exactly(static_cast<double>(radius)), half = N::exactly(0.5 * static_cast<double>(width));
  const N rho_squared = X * X + Y * Y;
  const N inside = half * half - rho_squared;
  switch (side_of_rim(inside, is_left_of_centre)) {
    case Side::outside: return flat<N>();
    case Side::unknown: return undecided<N>();
    case Side::inside: break;
  }
  const N depth = square_root((R - half) * (R + half)), above_axis = square_root(R * R - rho_squared);
  // The difference of the roots as that of their squares, (w/2)² - ρ², over their sum: no cancellation near the rim.
  const N steepness = -(N::exactly(1) / above_axis);
  return {inside / (above_axis + depth), steepness * X, steepness * Y};
}

template <class N>
Jet<N> jet(const height::SphereCap& cap, const Place& at) noexcept {
  return cap_jet(cap.radius, cap.width, difference<N>(at.x(), cap.x), difference<N>(at.y(), cap.y),
                 at.x() < static_cast<double>(cap.x));
}

template <class N>
Jet<N> jet(const height::CylinderCap& cap, const Place& at) noexcept {
  return cap_jet(cap.radius, cap.width, difference<N>(at.x(), cap.x), N::exactly(0), at.x() < static_cast<double>(cap.x));
}

}  // namespace forceshade::fast
