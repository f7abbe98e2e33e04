// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exact side's forces as enclosures of 64 bits, and what they are made of: for properties that need a size, not a proof.

#include "forceshade/reference.h"
#include "reference/laws/bump_geometry.h"
#include "reference/laws/force.h"
#include "reference/numbers/ball64.h"

namespace forceshade::reference {

// The facet a valid position is on and the force there to about 17 digits.
struct Law::Estimate {
  Facet facet;
  Force<Ball64> force;
};

// The force at a valid position to about 17 digits, and what it is made of, for properties that need a size, not a proof.
// No force acts where the gap is not positive, whatever x, y and z say.
struct HeightMapField::Estimate {
  Ball64 gap;      // mm: the penetration
  Ball64 Ux, Uy;   // mm/mm: the gradient that the direction comes from
  Ball64 x, y, z;  // N
};

}  // namespace forceshade::reference
