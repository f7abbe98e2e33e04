// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gaussian: U = height·exp(-ρ²/2σ²). Off the centre its height is transcendental:
// at a position an Enclosure or an ExponentialSum.

#include "forceshade/reference/heights/jet.h"

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

}  // namespace forceshade::reference
