// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// plane: U = height + slope_x·x + slope_y·y.

#include "reference/heights/kind.h"

namespace forceshade::reference {

template <class N>
Jet<N> plane_jet(const height::Plane& plane, const N& x, const N& y) {
  const N a(static_cast<double>(plane.slope_x)), b(static_cast<double>(plane.slope_y));
  return {N(static_cast<double>(plane.height)) + a * x + b * y, a, b};
}

template <class N>
Jet<N> jet(const height::Plane& plane, const Point2& at) {
  return plane_jet(plane, N(at.x), N(at.y));
}

template <>
constexpr Formula formula<height::Plane>() {
  return Formula::polynomial;
}

inline DomainError error_of(const height::Plane& p) {
  if (const auto error = check("slope x", "", p.slope_x, -1000, 1000)) return error;
  if (const auto error = check("slope y", "", p.slope_y, -1000, 1000)) return error;
  return check_height(p.height);
}

inline void cut(const height::Plane&, Cuts&) {}
template <class N>
Jet<N> jet_in(const height::Plane& plane, const OnWay<N>& at) {
  return plane_jet(plane, at.x, at.y);
}

inline std::optional<ConstantGradient> constant_gradient(const height::Plane& p) {
  return ConstantGradient{Rational(static_cast<double>(p.slope_x)), Rational(static_cast<double>(p.slope_y))};
}

inline double tallest(const height::Plane& p, double largest_x, double largest_y) {
  return size_of(p.height) + size_of(p.slope_x) * largest_x + size_of(p.slope_y) * largest_y;
}

inline Outline outline_of(const height::Plane& p) {
  Outline shape{.kind = "plane", .steepest = std::hypot(static_cast<double>(p.slope_x), static_cast<double>(p.slope_y))};
  shape.xs = shape.ys = {0};
  return shape;
}

}  // namespace forceshade::reference
