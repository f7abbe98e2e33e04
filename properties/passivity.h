// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passivity: around a closed path the renderer gives the hand no more energy than the exact law does plus its rounding, and
// nothing but rounding where the law is conservative.

#include "forceshade/properties/work.h"

namespace forceshade::properties {

Violation passivity(const Subject& subject, const Shape& shape, const std::vector<PathPoint>& vertices);

// A loop that draws energy from an active law, as docs/laws.md lists it.
struct WitnessLoop {
  std::vector<PathPoint> vertices;  // in the order in which the hand is paid
  double listed_mJ;                 // what the closed form (or, for the shaded polygons, its integral) says it pays
};

// The most energy given per simple loop of depth (mm) at most `depth` on one half of the bump; for the conservative laws
// a loop through the object and a listed energy of 0. No loop where the line x = w/2 is the end of the position domain:
// what lies beyond has no force. depth in (0, R], mm.
WitnessLoop witness_loop(const Shape& shape, double depth);

// Whether the witness loop, walked with the renderer, is paid what is listed, to within its own rounding and one part in 10^4.
Violation witness_is_reached(const Subject& subject, const Shape& shape, double depth);

}  // namespace forceshade::properties
