// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a height map's force gives the hand along a path, as guaranteed enclosures (docs/energy.md, "Height maps"). The field is
// that of the formulas at real positions: the position quantum, a rule for reading binary32, has no part in it.

#include <optional>
#include <string>

#include "forceshade/reference/height_law.h"

namespace forceshade::reference {

// The formula of the field's potential, mJ; nothing where no closed path is known to pay nothing: true heights have one where
// every part is a plane or level, shaded ones where that holds of the surface too, and both have one gradient.
std::optional<std::string> potential(const HeightLaw& law);

}  // namespace forceshade::reference
