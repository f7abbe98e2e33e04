// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Triangles whose insides, without their borders, have a point in common, exactly.

#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {

// Both have an area.
bool insides_meet(const TrianglePoints& s, const TrianglePoints& t);

}  // namespace forceshade::mesh
