// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gaussian: U = height·exp(-ρ²/2σ²). Enclosures alone: off the centre its height is transcendental.

#include "forceshade/reference/height_jet.h"

namespace forceshade::reference {

inline Jet<Enclosure> jet(const height::Gaussian& gaussian, const Point2& at) {
  const auto x = from_centre<Enclosure>(at.x, gaussian.x), y = from_centre<Enclosure>(at.y, gaussian.y);
  const Enclosure sigma(gaussian.sigma);
  const Enclosure variance = sigma * sigma;
  const Enclosure U = Enclosure(gaussian.height) * exp(Enclosure(-(x * x + y * y) / (2 * variance)));
  return {U, -x / variance * U, -y / variance * U};
}

}  // namespace forceshade::reference
