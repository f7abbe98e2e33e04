// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cone: U = height·(1 - ρ/radius) for ρ < radius, else 0; at the apex ∇U = (-height/radius, 0).

#include "reference/heights/kind.h"

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

template <>
constexpr Formula formula<height::Cone>() {
  return Formula::with_roots;
}

inline DomainError error_of(const height::Cone& c) {
  if (const auto error = check_centre(c.x, c.y)) return error;
  if (const auto error = check_height(c.height)) return error;
  return check("radius", "mm", c.radius, 0.001F, 10000);
}

inline void cut(const height::Cone& cone, Cuts& cuts) {
  const Rational x = from_centre<Rational>(static_cast<double>(cuts.segment().x0), cone.x);
  const Rational y = from_centre<Rational>(static_cast<double>(cuts.segment().y0), cone.y);
  const bool is_through_apex = sign(Rational(x * cuts.along_y<Rational>() - y * cuts.along_x<Rational>())) == 0;
  const auto radius = [&]<class N>() -> N { return Cuts::number<N>(cone.radius); };
  cuts.circle(cone.x, cone.y, radius, is_through_apex ? kTowardsApex : kInside, is_through_apex ? kFromApex : kInside);
  if (!is_through_apex) return;
  const auto apex = [&]<class N>() -> N { return cuts.nearest<N>(cone.x, cone.y); };
  cuts.add(apex, {kFromApex - kTowardsApex, 0});
}
template <class N>
Jet<N> jet_in(const height::Cone& cone, const OnWay<N>& at) {
  if (at.cell.column == kOutside) return Jet<N>::flat();
  const N X = at.x_from(cone.x), Y = at.y_from(cone.y);
  if (at.cell.column == kInside) return slope_jet(cone, X, Y);
  // Along a ray: ρ itself is linear in t.
  const N length = sqrt(N(at.dx * at.dx + at.dy * at.dy)), sign(at.cell.column == kFromApex ? 1.0 : -1.0);
  const N along_x = sign * at.dx / length, along_y = sign * at.dy / length;
  return ray_jet(cone, N(X * along_x + Y * along_y), along_x, along_y);
}

inline std::optional<ConstantGradient> constant_gradient(const height::Cone& c) {
  return level_if(c.height == 0);
}

inline double tallest(const height::Cone& c, double, double) {
  return size_of(c.height);
}

inline Outline outline_of(const height::Cone& cone) {
  Outline shape = round_outline("cone", cone.x, cone.y, cone.radius);
  const auto radius = static_cast<double>(cone.radius);
  shape.steepest = std::fabs(static_cast<double>(cone.height)) / radius;
  shape.rim = Rim{shape.x, shape.y, radius};
  if (cone.height != 0) shape.kinks = {"its apex", "its rim"};
  shape.gradient_change = [rim = *shape.rim, fall = shape.steepest](double x, double y, double reach) {
    const double rho = std::hypot(x - rim.x, y - rim.y), nearest = rho - reach;
    if (nearest > rim.radius + kOutlineSlack) return GradientChange{};
    return GradientChange{fall / std::max(nearest, kOutlineSlack),
                          nearest <= reach + kOutlineSlack || rho + reach >= rim.radius - kOutlineSlack};
  };
  return shape;
}

}  // namespace forceshade::reference
