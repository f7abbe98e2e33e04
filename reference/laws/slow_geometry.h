// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The geometry of a bump in the two slow number types. Callers hold exact_arithmetic.

#include "reference/laws/bump_geometry.h"
#include "reference/numbers/numbers.h"

namespace forceshade::reference {

// The choice to compute w′ and h′, which takes the longest, or to leave them at 0 for a law whose surface has no flat top.
enum class FlatTop { needed, not_needed };

// The geometry from the printed formulas, θ = (2/3) arcsin(w/2R), at the precision last set by set_precision().
BumpGeometry<Enclosure> enclosing_geometry(const Parameters& parameters, FlatTop top = FlatTop::needed);
Enclosure enclosing_theta(const Parameters& parameters);

// The geometry from t = sin(α/3): the root of 4t³ - 3t + w/2R in (0, ½], isolated by CGAL's algebraic kernel.
BumpGeometry<Exact> exact_geometry(const Parameters& parameters, FlatTop top = FlatTop::needed);

}  // namespace forceshade::reference
