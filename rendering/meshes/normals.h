// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The corner normals of the vertex scheme, each component correctly rounded.

#include <cstdint>

#include "rendering/meshes/check.h"

namespace forceshade::mesh {

// How many components binary64 decided, and how many it left to intervals of more bits.
struct NormalStages {
  std::uint64_t binary64 = 0, intervals = 0;
};

struct ComputedNormals {
  CornerNormals normals;
  NormalStages stages;
};

// At each corner the unit mean of the unit normals of the triangles around its vertex, weighted by their angles there: of those
// that are joined to the corner's own triangle over edges at the vertex that do not separate. An edge separates if its
// triangles turn by more than the crease angle, 0 to 180 degrees; at 180 none does. Each component is the binary32 number
// nearest to the exact one; zeros are +0. Where the mean is 0 and so has no direction, the normal is (0, 0, 0), which shades
// nothing. Throws std::invalid_argument where the angle is out of its range.
ComputedNormals corner_normals(const CheckedMesh& mesh, double crease_degrees = 180);

}  // namespace forceshade::mesh
