// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// grating: U = height·cos(wave_x·x + wave_y·y + phase).

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"
#include "fast/numbers/exp_cos_sin.h"

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

inline MaybeError error_of(const height::Grating& g) noexcept {
  using height_limits::kLargestSlope;
  return first_outside({height_of(g.height), symmetric("wave x", "rad/mm", g.wave_x, kLargestSlope),
                        symmetric("wave y", "rad/mm", g.wave_y, kLargestSlope),
                        symmetric("phase", "rad", g.phase, kLargestSlope)});
}

// The height is a multiple of the cosine, the slopes are multiples of the sine, of one angle.
inline void add_terms(const height::Grating& grating, const Place& at, ExactTerms& terms) noexcept {
  const Fraction height = Fraction::exactly(static_cast<double>(grating.height)),
                 a = Fraction::exactly(static_cast<double>(grating.wave_x)),
                 b = Fraction::exactly(static_cast<double>(grating.wave_y));
  const Fraction angle =
      a * Fraction::exactly(at.x()) + b * Fraction::exactly(at.y()) + Fraction::exactly(static_cast<double>(grating.phase));
  if (angle.is_zero()) return terms.add_rational({height, {}, {}});
  const bool is_negative = sign(angle) == Sign::negative;
  const Fraction steepness = is_negative ? height : -height;
  terms.add_wave(is_negative ? -angle : angle, {height, steepness * a, steepness * b});
}
inline DenominatorBits denominator_bits(const height::Grating&) noexcept {
  return {};
}

}  // namespace forceshade::fast
