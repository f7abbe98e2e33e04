// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which triangles of a mesh share an edge. Half-edge 3 i + k of triangle i leads from its corner k to the next one.

#include <cstdint>
#include <functional>
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
void for_each_edge(const TriangleMesh& mesh, const std::function<void(std::span<const std::uint32_t> half_edges)>& edge);

// The half-edge that runs along each in the other direction, or kNoEdge. The mesh has edges of one or two triangles, two of
// which run along them in opposite directions; a half-edge of any other edge has kNoEdge.
std::vector<std::uint32_t> opposite_half_edges(const TriangleMesh& mesh);

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
