// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws whose force is K·(H - z) along a direction, at x >= 0: vertical strips in each of which H is linear. At x < 0 they
// are their own mirror images. Callers hold exact_arithmetic.

#include <vector>

#include "forceshade/reference.h"
#include "reference/laws/bump_geometry.h"
#include "reference/numbers/numbers.h"

namespace forceshade::reference {

// 77 digits: 25 remain where a bump a micrometre wide is cut from a radius of ten metres and the antiderivatives cancel.
inline constexpr unsigned kEnergyBits = 256;

struct Strip {
  Enclosure left, right;  // mm; the line x = right belongs to this strip
  Enclosure end, slope;   // mm and 1: H(right) and dH/dx; a slope that is zero is exactly [0, 0]
  bool is_shaded;         // pushes along the cylinder's normal, else along its own

  Enclosure height(const Enclosure& x) const { return end + slope * (x - right); }
};

struct Half {
  BumpGeometry<Enclosure> g;
  std::vector<Strip> strips;  // from x = 0 to the end of the position domain; none for the cylinder and bump-cylinder
};

// At the precision in force.
Half half_of(const Law& law);

// √(R² - x²) for x in [0, R], also where the enclosure of x reaches a little beyond R.
Enclosure height_over_axis(const BumpGeometry<Enclosure>& g, const Enclosure& x);

// ∫√(R² - x²) dx from 0 to x.
Enclosure area_over_axis(const BumpGeometry<Enclosure>& g, const Enclosure& x);

// F_z over the force's size, at an x of the strip.
Enclosure share_upwards(const BumpGeometry<Enclosure>& g, const Strip& strip, const Enclosure& x);

}  // namespace forceshade::reference
