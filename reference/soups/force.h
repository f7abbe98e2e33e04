// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force of a god-object at rest on any set of triangles, exactly (docs/soups.md).

#include <array>

#include "reference/meshes/rounding.h"
#include "reference/soups/tick.h"

namespace forceshade::reference::soups {

// K D; with corner normals, one for each corner of each triangle of the file, K (|D_n| N/|N| + D_t). stiffness: K, N/mm.
std::array<meshes::RootSum, 3> exact_force(const Rest& rest, float stiffness, const mesh::CornerNormals& normals = {});

}  // namespace forceshade::reference::soups
