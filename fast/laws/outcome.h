// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A law's answer in Ball arithmetic (fast/numbers/ball.h), before rounding: what every law's exact stage returns.

#include "fast/numbers/ball.h"

namespace forceshade::fast {

template <class N>
struct Outcome {
  Sign contact;  // positive: the law acts and the components hold; negative or zero: it does not
  N x, z;        // N
};

// F = K·gap·(normal_x, normal_z) where gap > 0.
template <class N>
Outcome<N> along(const N& gap, float K, const N& normal_x, const N& normal_z) noexcept {
  const N magnitude = N::exactly(static_cast<double>(K)) * gap;
  return {sign(gap), magnitude * normal_x, magnitude * normal_z};
}

// F = K·(-z)·ẑ where z < 0: the plane beside the bump.
template <class N>
Outcome<N> on_plane(float K, float z) noexcept {
  return along(N::exactly(-static_cast<double>(z)), K, N::exactly(0), N::exactly(1));
}

// F = K·gap·(x/R, √(R² - x²)/R) where gap > 0: force shading with the cylinder's normal.
template <class N>
Outcome<N> along_shaded(const N& gap, float K, float radius, float x) noexcept {
  const N R = N::exactly(static_cast<double>(radius));
  const N X = N::exactly(static_cast<double>(x));
  return along(gap / R, K, X, square_root((R - X) * (R + X)));
}

}  // namespace forceshade::fast
