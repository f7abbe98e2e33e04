// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/edges.h"

#include <algorithm>

namespace forceshade::mesh {

void for_each_edge(const TriangleMesh& mesh, const std::function<void(std::span<const std::uint32_t> half_edges)>& edge) {
  const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  const auto lower = [&](std::uint32_t h) { return std::min(start_of(mesh, h), end_of(mesh, h)); };
  const auto higher = [&](std::uint32_t h) { return std::max(start_of(mesh, h), end_of(mesh, h)); };
  // Sorted by the lower vertex; first[v] is the place of the first of vertex v, and of the last behind all of them.
  std::vector<std::uint32_t> first(mesh.vertices.size() + 2), sorted(count);
  for (std::uint32_t h = 0; h < count; ++h) ++first[lower(h) + 2];
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  for (std::uint32_t h = 0; h < count; ++h) sorted[first[lower(h) + 1]++] = h;
  std::vector<std::uint64_t> of_vertex;  // the higher vertex, then the half-edge
  std::vector<std::uint32_t> half_edges;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    of_vertex.clear();
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i)
      of_vertex.push_back(std::uint64_t{higher(sorted[i])} << 32 | sorted[i]);
    std::sort(of_vertex.begin(), of_vertex.end());
    for (std::size_t i = 0; i < of_vertex.size();) {
      half_edges.clear();
      const std::uint64_t other = of_vertex[i] >> 32;
      for (; i < of_vertex.size() && of_vertex[i] >> 32 == other; ++i)
        half_edges.push_back(static_cast<std::uint32_t>(of_vertex[i]));
      edge(half_edges);
    }
  }
}

std::vector<std::uint32_t> opposite_half_edges(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> opposite(3 * mesh.triangles.size(), kNoEdge);
  for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
    if (half_edges.size() != 2 || start_of(mesh, half_edges[0]) == start_of(mesh, half_edges[1])) return;
    opposite[half_edges[0]] = half_edges[1];
    opposite[half_edges[1]] = half_edges[0];
  });
  return opposite;
}

}  // namespace forceshade::mesh
