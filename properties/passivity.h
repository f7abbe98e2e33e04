// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passivity: around a closed path the renderer gives the hand no more energy than the exact law does plus its rounding, and
// nothing but rounding where the law is conservative.

#include <array>

#include "properties/work.h"

namespace forceshade::properties {

Violation passivity(const RenderedLaw& rendered, const LawClaims& claims, const std::vector<PathPoint>& vertices);

// The loop that shows how much energy a law gives (docs/energy.md); for a conservative law one through the object, which gives
// none.
struct WitnessLoop {
  std::vector<PathPoint> vertices;  // in the order in which the hand is given energy
  std::array<double, 2> bound_mJ;   // an interval around the most that a simple loop this deep can give
  double given_mJ;                  // by the exact law, rounded down; 99 % of the bound or more
};

// depth: mm, as for reference::witness.
WitnessLoop witness_loop(const reference::Law& law, float depth);

// Demands that the renderer gives around the witness loop what the exact law gives, to within its own rounding and one part in
// 10^4, and that this reaches the bound.
Violation witness_is_reached(const RenderedLaw& rendered, const LawClaims& claims, float depth);

}  // namespace forceshade::properties
