// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder cap: a cap of ρ = |X|, the distance from its axis.

#include "reference/heights/cap.h"

namespace forceshade::reference {

template <class N>
Jet<N> ridge_jet(const height::CylinderCap& cap, const N& x) {
  Jet<N> ridge = cap_jet(cap.radius, cap.width, x, N(0.0));
  ridge.Uy = N(0.0);
  return ridge;
}

template <class N>
Jet<N> jet(const height::CylinderCap& cap, const Point2& at) {
  const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
  if (!is_inside(from_centre<Rational>(at.x, cap.x), Rational(0), half)) return Jet<N>::flat();
  return ridge_jet(cap, from_centre<N>(at.x, cap.x));
}

template <>
constexpr Formula formula<height::CylinderCap>() {
  return Formula::with_roots;
}

inline DomainError error_of(const height::CylinderCap& c) {
  if (const auto error = check_centre(c.x, 0)) return error;
  return check_cap(c.radius, c.width);
}

inline void cut(const height::CylinderCap& cap, Cuts& cuts) {
  const Segment& way = cuts.segment();
  if (way.x0 == way.x1) {
    const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
    const bool is_in = is_inside(from_centre<Rational>(static_cast<double>(way.x0), cap.x), Rational(0), half);
    cuts.cells.back().column = is_in ? kInside : kOutside;
    return;
  }
  const float first = way.x0 < way.x1 ? -cap.width : cap.width;
  for (const float side : {first, -first}) {
    const auto rim = [&]<class N>() -> N {
      return (Cuts::number<N>(side) / N(2.0) - from_centre<N>(static_cast<double>(way.x0), cap.x)) / cuts.along_x<N>();
    };
    cuts.add(rim, {side == first ? kInside - kOutside : kOutside - kInside, 0});
  }
}
template <class N>
Jet<N> jet_in(const height::CylinderCap& cap, const OnWay<N>& at) {
  return at.cell.column == kOutside ? Jet<N>::flat() : ridge_jet(cap, at.x_from(cap.x));
}

inline std::optional<ConstantGradient> constant_gradient(const height::CylinderCap&) {
  return std::nullopt;
}

inline double tallest(const height::CylinderCap& c, double, double) {
  return height_of_cap(c.radius, c.width);
}

inline Outline outline_of(const height::CylinderCap& cap) {
  Outline shape = round_outline("cylinder-cap", cap.x, 0, cap.width / 2);
  const auto radius = static_cast<double>(cap.radius), half = 0.5 * static_cast<double>(cap.width);
  shape.steepest = steepest_of_cap(radius, half);
  shape.kinks = {"its two edges"};
  shape.gradient_change = [axis = shape.x, radius, half](double x, double, double reach) {
    return change_of_cap(radius, half, std::fabs(x - axis), reach);
  };
  return shape;
}

}  // namespace forceshade::reference
