// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Decides exactly if two triangles turn by more than an angle.

#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {

// True if the angle between their normals is more than the crease angle, 0 to 180 degrees.
bool turns_by_more(const TrianglePoints& s, const TrianglePoints& t, double crease_degrees);

}  // namespace forceshade::mesh
