// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh as an OFF or OBJ file, in mm.

#include <ostream>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

// Each coordinate as the shortest decimal that is read as the same binary32 number, whatever the locale.
void write_off(std::ostream& out, const TriangleMesh& mesh);

// Writes an OBJ file in the same decimals; with the points of a texture where there are any, one for each corner of each
// triangle.
void write_obj(std::ostream& out, const TriangleMesh& mesh, const std::vector<std::array<TexturePoint, 3>>& texture);

}  // namespace forceshade::mesh
