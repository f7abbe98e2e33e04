// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places of the corners of a mesh on a height map that is laid over it, and the speed of the map along the surface.

#include <vector>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

// points: of each corner of each triangle, in mm, each number within 10^4 and 0 or at least 2^-30 in size.
//
// The gradients of a corner are means over the triangles around its vertex, weighted by their areas: of those that are joined
// to the corner's own triangle over edges at the vertex that do not separate. An edge separates if its triangles turn by more
// than the crease angle, have different points at either of its ends, or only one of them is turned over in the texture. Each
// component is the binary32 number nearest to the exact one, ties to even, and 0 below 2^-30 in size; one that 1280 bits do not
// separate from a tie is taken for the tie.
//
// Throws std::invalid_argument, with the number of the face, where a triangle has no area in the texture or a component of a
// gradient is above 1000.
CornerTextures corner_textures(const CheckedMesh& mesh, const std::vector<std::array<TexturePoint, 3>>& points,
                               double crease_degrees = 180);

}  // namespace forceshade::mesh
