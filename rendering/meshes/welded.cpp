// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/welded.h"

#include <algorithm>
#include <span>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/predicates.h"
#include "rendering/meshes/weld.h"

namespace forceshade::mesh {

Welded welded(const TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  Welder welder;
  std::vector<std::uint32_t> first, lowest(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    const std::uint32_t place = welder.place_of(mesh.vertices[v]);
    if (place == first.size()) first.push_back(v);
    lowest[v] = first[place];
  }
  Welded result{{mesh.vertices, {}}, {}};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (!has_area({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]})) continue;
    result.mesh.triangles.push_back({lowest[a], lowest[b], lowest[c]});
    result.number.push_back(i);
  }
  return result;
}

Sides usual_sides(const CheckedMesh& checked) {
  const auto is_balanced = [](const TriangleMesh& mesh) {
    bool is_so = true;
    for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
      const auto one_way = std::ranges::count_if(
          half_edges, [&](std::uint32_t h) { return start_of(mesh, h) == start_of(mesh, half_edges[0]); });
      is_so = is_so && 2 * static_cast<std::size_t>(one_way) == half_edges.size();
    });
    return is_so;
  };
  return is_balanced(checked.is_regular() ? checked.mesh() : welded(checked.mesh()).mesh) ? Sides::front : Sides::both;
}

}  // namespace forceshade::mesh
