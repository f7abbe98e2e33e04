// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gaussian: U = height·exp(-ρ²/2σ²). Off the centre its height is transcendental:
// at a position an Enclosure or an ExponentialSum.

#include "reference/heights/kind.h"

namespace forceshade::reference {

// x, y: from the centre.
template <class N>
Jet<N> hill_jet(const height::Gaussian& gaussian, const N& x, const N& y) {
  const N sigma(static_cast<double>(gaussian.sigma));
  const N variance = sigma * sigma;
  const N U = N(static_cast<double>(gaussian.height)) * exp(N(-(square(x) + square(y)) / (N(2.0) * variance)));
  return {U, -x / variance * U, -y / variance * U};
}

template <class N>
Jet<N> jet(const height::Gaussian& gaussian, const Point2& at) {
  return hill_jet(gaussian, from_centre<N>(at.x, gaussian.x), from_centre<N>(at.y, gaussian.y));
}

template <>
constexpr Formula formula<height::Gaussian>() {
  return Formula::transcendental;
}

inline DomainError error_of(const height::Gaussian& g) {
  if (const auto error = check_centre(g.x, g.y)) return error;
  if (const auto error = check_height(g.height)) return error;
  return check("sigma", "mm", g.sigma, 0.001F, 10000);
}

inline void cut(const height::Gaussian&, Cuts&) {}
template <class N>
Jet<N> jet_in(const height::Gaussian& g, const OnWay<N>& at) {
  return hill_jet(g, at.x_from(g.x), at.y_from(g.y));
}

inline std::optional<ConstantGradient> constant_gradient(const height::Gaussian& g) {
  return level_if(g.height == 0);
}

inline double tallest(const height::Gaussian& g, double, double) {
  return size_of(g.height);
}

inline Outline outline_of(const height::Gaussian& hill) {
  Outline shape = round_outline("gaussian", hill.x, hill.y, hill.sigma);
  shape.reach *= 3;
  const double height = std::fabs(static_cast<double>(hill.height)), sigma = static_cast<double>(hill.sigma);
  shape.steepest = height / sigma * std::exp(-0.5);
  // The second derivatives are those of exp(-u²/2), u = ρ/σ: at most exp(-u²/2), or (u² - 1)·exp(-u²/2), largest at u = √3.
  shape.gradient_change = [x0 = shape.x, y0 = shape.y, height, sigma](double x, double y, double reach) {
    const double u = std::max(0.0, std::hypot(x - x0, y - y0) - reach) / sigma, fallen = std::exp(-0.5 * u * u);
    const double size = u * u < 3 ? std::max(fallen, 2 * std::exp(-1.5)) : (u * u - 1) * fallen;
    return GradientChange{height / (sigma * sigma) * size, false};
  };
  return shape;
}

}  // namespace forceshade::reference
