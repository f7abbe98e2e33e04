// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grating: U = height·cos(wave_x·x + wave_y·y + phase).

#include "forceshade/fast/heights/jet.h"
#include "forceshade/fast/numbers/exp_cos_sin.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::Grating& grating, const Place& at) noexcept {
  const auto a = static_cast<double>(grating.wave_x), b = static_cast<double>(grating.wave_y);
  const auto phase = static_cast<double>(grating.phase);
  const N height = N::exactly(static_cast<double>(grating.height));
  const double size = std::fabs(a * at.x()) + std::fabs(b * at.y()) + std::fabs(phase);
  if (size == 0) return {height, N::exactly(0), N::exactly(0)};
  const N angle = (N::exactly(a) * N::exactly(at.x()) + N::exactly(b) * N::exactly(at.y())) + N::exactly(phase);
  const CosineAndSine<N> of = cosine_and_sine(angle, 2 * size);
  const N steepness = -(height * of.sine);
  return {height * of.cosine, N::exactly(a) * steepness, N::exactly(b) * steepness};
}

}  // namespace forceshade::fast
