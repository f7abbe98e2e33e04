// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles of a mesh that share an edge. Half-edge 3 i + k of triangle i leads from its corner k to the next one.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

inline constexpr std::uint32_t kNoEdge = 0xFFFFFFFF;

inline std::uint32_t next_in_triangle(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
inline std::uint32_t previous_in_triangle(std::uint32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}
inline std::uint32_t start_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
  return mesh.triangles[half_edge / 3][half_edge % 3];
}
inline std::uint32_t end_of(const TriangleMesh& mesh, std::uint32_t half_edge) {
  return start_of(mesh, next_in_triangle(half_edge));
}

// Calls edge(half_edges) once for each edge, with all half-edges between its two vertices, the lowest first. The edges come in
// the order of their lower vertex, then of the other. Every index is that of a vertex, and no triangle has a vertex twice.
template <class Edge>
void for_each_edge(const TriangleMesh& mesh, const Edge& edge) {
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
      edge(std::span<const std::uint32_t>(half_edges));
    }
  }
}

// The half-edge that runs along each in the other direction, or kNoEdge. The mesh has edges of one or two triangles, two of
// which run along them in opposite directions; a half-edge of any other edge has kNoEdge.
inline std::vector<std::uint32_t> opposite_half_edges(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> opposite(3 * mesh.triangles.size(), kNoEdge);
  for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
    if (half_edges.size() != 2 || start_of(mesh, half_edges[0]) == start_of(mesh, half_edges[1])) return;
    opposite[half_edges[0]] = half_edges[1];
    opposite[half_edges[1]] = half_edges[0];
  });
  return opposite;
}

// Calls corner(half_edge) for each half-edge that starts at the start of `half_edge` and is reached from it over edges with two
// triangles, each once.
template <class Corner>
void walk_around(const std::vector<std::uint32_t>& opposite, std::uint32_t half_edge, const Corner& corner) {
  std::uint32_t at = half_edge;
  do {
    corner(at);
    at = opposite[previous_in_triangle(at)];
  } while (at != kNoEdge && at != half_edge);
  if (at == half_edge) return;
  for (at = opposite[half_edge]; at != kNoEdge; at = opposite[at]) {
    at = next_in_triangle(at);
    corner(at);
  }
}

}  // namespace forceshade::mesh
