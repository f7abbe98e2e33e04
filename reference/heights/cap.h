// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The formula of cylinder cap and sphere cap: U = √(R² - ρ²) - √(R² - (w/2)²) for 2ρ < w, else 0.

#include "reference/heights/kind.h"

namespace forceshade::reference {

// Inside the rim; x, y: from the centre.
template <class N>
Jet<N> cap_jet(float radius, float width, const N& x, const N& y) {
  const N R(static_cast<double>(radius)), half = N(static_cast<double>(width)) / N(2.0);
  const N above_axis = sqrt(N(R * R - square(x) - square(y)));
  return {above_axis - sqrt(N(R * R - half * half)), -x / above_axis, -y / above_axis};
}

inline DomainError check_cap(float radius, float width) {
  if (const auto error = check("radius", "mm", radius, 0.1F, 10000)) return error;
  return check("width", "mm", width, 0.001F, std::nextafter(2 * radius, 0.0F));
}

// A part in a million more than R - sqrt(R² - (w/2)²).
inline double height_of_cap(float radius, float width) {
  const double R = size_of(radius), half = size_of(width) / 2;
  return half * half / (R + std::sqrt((R - half) * (R + half))) * (1 + 1e-6);
}

// rho: from the axis or centre, mm.
inline GradientChange change_of_cap(double radius, double half, double rho, double reach) {
  if (rho - reach > half + kOutlineSlack) return {};
  const double farthest = std::min(rho + reach, half);
  return {radius * radius / std::pow(radius * radius - farthest * farthest, 1.5), rho + reach >= half - kOutlineSlack};
}

inline double steepest_of_cap(double radius, double half) {
  return half / std::sqrt((radius - half) * (radius + half));
}

}  // namespace forceshade::reference
