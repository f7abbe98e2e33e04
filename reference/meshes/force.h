// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force at rest, each component rounded once to binary32.

#include "forceshade/reference/meshes/descent.h"

namespace forceshade::reference::meshes {

// K D; stiffness in N/mm, the force in N.
std::array<float, 3> unshaded_force(const Rest& rest, float stiffness);

// K |D| N/|N|, with N from the corner normals (docs/meshes.md); K D where these give no direction.
std::array<float, 3> vertex_scheme_force(const Surface& surface, const mesh::CornerNormals& normals, const Rest& rest,
                                         float stiffness);

}  // namespace forceshade::reference::meshes
