// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grating: U = height·cos(wave_x·x + wave_y·y + phase). Where the angle is not 0 its height is transcendental: at a position an
// Enclosure or an ExponentialSum.

#include "forceshade/reference/heights/jet.h"

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

}  // namespace forceshade::reference
