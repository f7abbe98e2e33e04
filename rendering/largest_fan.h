// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vertex at which a triangle mesh has most triangles.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

// The first of several, and their number; 0 and 0 without a vertex.
inline std::pair<std::uint32_t, std::uint32_t> vertex_of_most(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> triangles(mesh.vertices.size(), 0);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) ++triangles[vertex];
  const auto most = std::ranges::max_element(triangles);
  if (most == triangles.end()) return {};
  return {static_cast<std::uint32_t>(most - triangles.begin()), *most};
}

}  // namespace forceshade::mesh
