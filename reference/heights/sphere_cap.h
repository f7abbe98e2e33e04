// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// sphere cap: a cap of ρ, the distance from its centre.

#include "reference/heights/cap.h"

namespace forceshade::reference {

template <class N>
Jet<N> jet(const height::SphereCap& cap, const Point2& at) {
  const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
  if (!is_inside(from_centre<Rational>(at.x, cap.x), from_centre<Rational>(at.y, cap.y), half)) return Jet<N>::flat();
  return cap_jet(cap.radius, cap.width, from_centre<N>(at.x, cap.x), from_centre<N>(at.y, cap.y));
}

template <>
constexpr Formula formula<height::SphereCap>() {
  return Formula::with_roots;
}

inline DomainError error_of(const height::SphereCap& c) {
  if (const auto error = check_centre(c.x, c.y)) return error;
  return check_cap(c.radius, c.width);
}

inline void cut(const height::SphereCap& cap, Cuts& cuts) {
  const auto half = [&]<class N>() -> N { return Cuts::number<N>(cap.width) / N(2.0); };
  cuts.circle(cap.x, cap.y, half, kInside, kInside);
}
template <class N>
Jet<N> jet_in(const height::SphereCap& cap, const OnWay<N>& at) {
  if (at.cell.column == kOutside) return Jet<N>::flat();
  return cap_jet(cap.radius, cap.width, at.x_from(cap.x), at.y_from(cap.y));
}

inline std::optional<ConstantGradient> constant_gradient(const height::SphereCap&) {
  return std::nullopt;
}

inline double tallest(const height::SphereCap& c, double, double) {
  return height_of_cap(c.radius, c.width);
}

inline Outline outline_of(const height::SphereCap& cap) {
  Outline shape = round_outline("sphere-cap", cap.x, cap.y, cap.width / 2);
  const auto radius = static_cast<double>(cap.radius), half = 0.5 * static_cast<double>(cap.width);
  shape.steepest = steepest_of_cap(radius, half);
  shape.rim = Rim{shape.x, shape.y, half};
  shape.kinks = {"its rim"};
  shape.gradient_change = [rim = *shape.rim, radius](double x, double y, double reach) {
    return change_of_cap(radius, rim.radius, std::hypot(x - rim.x, y - rim.y), reach);
  };
  return shape;
}

}  // namespace forceshade::reference
