// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grating: U = height·cos(wave_x·x + wave_y·y + phase). Where the angle is not 0 its height is transcendental: at a position an
// Enclosure or an ExponentialSum.

#include "reference/heights/kind.h"

namespace forceshade::reference {

template <class N>
Jet<N> wave_jet(const height::Grating& grating, const N& x, const N& y) {
  const N height(static_cast<double>(grating.height)), wave_x(static_cast<double>(grating.wave_x)),
      wave_y(static_cast<double>(grating.wave_y));
  const N angle = wave_x * x + wave_y * y + N(static_cast<double>(grating.phase));
  const auto [sine, cosine] = sine_and_cosine(angle);
  const N steepness = -height * sine;
  return {height * cosine, wave_x * steepness, wave_y * steepness};
}

template <class N>
Jet<N> jet(const height::Grating& grating, const Point2& at) {
  return wave_jet(grating, N(at.x), N(at.y));
}

template <>
constexpr Formula formula<height::Grating>() {
  return Formula::transcendental;
}

inline DomainError error_of(const height::Grating& g) {
  if (const auto error = check_height(g.height)) return error;
  if (const auto error = check("wave x", "rad/mm", g.wave_x, -1000, 1000)) return error;
  if (const auto error = check("wave y", "rad/mm", g.wave_y, -1000, 1000)) return error;
  return check("phase", "rad", g.phase, -1000, 1000);
}

inline void cut(const height::Grating&, Cuts&) {}
template <class N>
Jet<N> jet_in(const height::Grating& grating, const OnWay<N>& at) {
  return wave_jet(grating, at.x, at.y);
}

inline std::optional<ConstantGradient> constant_gradient(const height::Grating& g) {
  return level_if(g.height == 0 || (g.wave_x == 0 && g.wave_y == 0));
}

inline double tallest(const height::Grating& g, double, double) {
  return size_of(g.height);
}

inline Outline outline_of(const height::Grating& grating) {
  const double wave = std::hypot(static_cast<double>(grating.wave_x), static_cast<double>(grating.wave_y));
  const double height = std::fabs(static_cast<double>(grating.height));
  Outline shape{.kind = "grating", .steepest = height * wave};
  shape.reach = std::clamp(20 / std::max(wave, 1e-6), 0.01, 1000.0);
  for (const auto& [along, marks] : {std::pair(grating.wave_x, &shape.xs), std::pair(grating.wave_y, &shape.ys)}) {
    *marks = {0};
    if (along != 0) marks->push_back(-grating.phase / along);  // a crest
  }
  shape.gradient_change = [rate = height * wave * wave](auto...) { return GradientChange{rate, false}; };
  return shape;
}

}  // namespace forceshade::reference
