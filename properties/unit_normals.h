// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Unit normals: the force is its magnitude times a unit vector, to within the rounding of its components; x = 0 included.

#include "properties/rendered.h"

namespace forceshade::properties {

// ‖F‖ must be K·penetration, up to half a unit in the last place of each component. For bump-cylinder, a sum of two
// objects, the wall's share is taken off first. Invalid positions hold trivially.
Violation unit_normals(const RenderedLaw& rendered, const Eigen::Vector3f& position);

// The same for a height map; for a conservative height map, whose normal is left as it is, ‖F‖ must be K·penetration·√(U_x² +
// U_y² + 1).
Violation unit_normals(const RenderedHeightMap& rendered, const Eigen::Vector3f& position);

}  // namespace forceshade::properties
