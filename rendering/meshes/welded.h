// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any set of triangles as docs/soups.md sees it.

#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

struct Welded {
  TriangleMesh mesh;  // the triangles with an area, whose vertices are the lowest used ones with their coordinates
  std::vector<std::uint32_t> number;  // that each of them had
};

// Every index is that of a vertex, and coordinates are as they were read.
Welded welded(const TriangleMesh& mesh);

}  // namespace forceshade::mesh
