// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edges of one triangle.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rendering/half_edges.h"

namespace forceshade::mesh {

struct BorderEdge {
  std::array<std::uint32_t, 2> ends;
  std::uint32_t triangle;
};

// In the order of their vertices. No triangle has a vertex twice.
inline std::vector<BorderEdge> border_edges(const TriangleMesh& mesh) {
  std::vector<BorderEdge> edges;
  for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
    const std::uint32_t h = half_edges[0];
    if (half_edges.size() == 1) edges.push_back({{start_of(mesh, h), end_of(mesh, h)}, h / 3});
  });
  return edges;
}

}  // namespace forceshade::mesh
