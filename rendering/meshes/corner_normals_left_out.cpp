// SPDX-License-Identifier: BSD-3-Clause
// In place of creases.cpp and doubtful_normals.cpp in a build without MPFI.
#include "rendering/left_out.h"
#include "rendering/meshes/creases.h"
#include "rendering/meshes/doubtful_normals.h"

namespace forceshade::mesh {

bool turns_by_more(const TrianglePoints&, const TrianglePoints&, double) {
  throw LeftOut("binary64 leaves in doubt whether two triangles turn by more than the crease angle", "corner-normals");
}

Normal normal_in_intervals(const std::vector<TrianglePoints>&) {
  throw LeftOut("binary64 leaves in doubt how a corner normal of the mesh is rounded", "corner-normals");
}

}  // namespace forceshade::mesh
