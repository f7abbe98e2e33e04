// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gaussian: U = height·exp(-ρ²/2σ²).

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"
#include "fast/numbers/exp_cos_sin.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::Gaussian& gaussian, const Place& at) noexcept {
  const N height = N::exactly(static_cast<double>(gaussian.height));
  const auto x = static_cast<double>(gaussian.x), y = static_cast<double>(gaussian.y),
             sigma = static_cast<double>(gaussian.sigma);
  if (at.x() == x && at.y() == y) return {height, N::exactly(0), N::exactly(0)};
  const N X = difference<N>(at.x(), gaussian.x), Y = difference<N>(at.y(), gaussian.y);
  const N variance = N::exactly(sigma) * N::exactly(sigma);
  const double size = ((at.x() - x) * (at.x() - x) + (at.y() - y) * (at.y() - y)) / (sigma * sigma);  // twice the exponent
  const N U = height * exp_of_minus((X * X + Y * Y) / (variance + variance), size);
  const N steepness = -(U / variance);
  return {U, steepness * X, steepness * Y};
}

inline MaybeError error_of(const height::Gaussian& g) noexcept {
  using namespace height_limits;
  return first_outside(
      {centre_x(g.x), centre_y(g.y), height_of(g.height), {"sigma", "mm", g.sigma, kSmallestReach, kLargestReach}});
}

inline void add_terms(const height::Gaussian& gaussian, const Place& at, ExactTerms& terms) noexcept {
  const Fraction height = Fraction::exactly(static_cast<double>(gaussian.height)),
                 sigma = Fraction::exactly(static_cast<double>(gaussian.sigma));
  const Fraction X = difference<Fraction>(at.x(), gaussian.x), Y = difference<Fraction>(at.y(), gaussian.y);
  const Fraction rho_squared = X * X + Y * Y;
  if (rho_squared.is_zero()) return terms.add_rational({height, {}, {}});
  const Fraction variance = sigma * sigma, steepness = -(height / variance);
  terms.add_decay(rho_squared / (variance + variance), {height, steepness * X, steepness * Y});
}
inline DenominatorBits denominator_bits(const height::Gaussian& gaussian) noexcept {
  return {0, 2 * odd_bits(gaussian.sigma)};
}

}  // namespace forceshade::fast
