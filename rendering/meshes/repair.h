// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Repair of a mesh that is none, on demand only. What it does is listed.

#include <string>
#include <vector>

#include "rendering/mesh.h"

namespace forceshade::mesh {

struct Repaired {
  TriangleMesh mesh;
  std::vector<std::string> done;  // one sentence each; empty if nothing was
};

// Repairs the mesh in this order: coordinates below 2^-30 mm in size are 0; vertices with equal coordinates are one, in the
// order in which they first come; faces go that have an index of no vertex, a coordinate that is no number within 10000 mm, a
// vertex twice or no area, and all but the first of several with the same vertices; faces are turned over until all that are
// joined over edges with two faces run along these in opposite directions, each part as its first face is, unless it cannot be
// done. Faces that are kept stay in their order. Nothing is moved, filled or cut: what is still no mesh then
// (rendering/meshes/check.h) is not repaired.
Repaired repair(TriangleMesh mesh);

}  // namespace forceshade::mesh
