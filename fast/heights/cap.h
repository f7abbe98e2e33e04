// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The formula of cylinder cap and sphere cap: U = √(R² - ρ²) - √(R² - (w/2)²) for 2ρ < w, else 0.

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"

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

inline ParameterError cap_radius(float radius) noexcept {
  return {"radius", "mm", radius, height_limits::kSmallestRadius, height_limits::kLargestRadius};
}
// A cap as wide as the whole cylinder or sphere would be infinitely steep at its rim.
inline ParameterError cap_width(float radius, float width) noexcept {
  return {"width", "mm", width, height_limits::kSmallestWidth, std::nextafter(2 * radius, 0.0F)};
}

// √(R² - ρ²) - √(R² - (w/2)²), with the gradient -(X, Y)·√(R² - ρ²)/(R² - ρ²).
inline void add_cap_terms(float radius, float width, const Fraction& X, const Fraction& Y, bool is_left_of_centre,
                          ExactTerms& terms) noexcept {
  const Fraction R = Fraction::exactly(static_cast<double>(radius)), half = Fraction::exactly(0.5 * static_cast<double>(width));
  const Fraction rho_squared = X * X + Y * Y, above_axis = R * R - rho_squared;
  if (side_of_rim(half * half - rho_squared, is_left_of_centre) != Side::inside) return;
  terms.add_root(above_axis, {Fraction::exactly(1), -X, -Y});
  terms.add_root(R * R - half * half, {Fraction::exactly(-1), {}, {}});
}

}  // namespace forceshade::fast
