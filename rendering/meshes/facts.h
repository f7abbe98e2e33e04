// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What there is to say about a mesh, for people. Nothing is decided by it.

#include <cstdint>

#include "rendering/meshes/check.h"

namespace forceshade::mesh {

struct Facts {
  std::uint64_t vertices = 0, triangles = 0;
  std::uint64_t unused_vertices = 0;           // in no triangle
  std::uint64_t edges = 0, rim_edges = 0;      // of all; with one triangle
  std::uint64_t parts = 0;                     // joined over edges
  Vertex low{}, high{};                        // mm: the box around the used vertices
  double shortest_edge = 0, longest_edge = 0;  // mm
  double area = 0;                             // mm^2
  double volume = 0;                           // mm^3, signed, of a closed mesh: negative where the fronts are inside; else 0

  bool is_closed() const { return rim_edges == 0; }
};

Facts facts_of(const JoinedMesh& mesh);

// The vertex with the most triangles, the first of several.
struct LargestFan {
  std::uint32_t vertex = 0;
  std::uint64_t triangles = 0;
};
LargestFan largest_fan(const TriangleMesh& mesh);
// The most triangles at a vertex with which no tick there takes longer than 0.1 ms (docs/meshes.md, "Vertices of many
// triangles").
inline constexpr std::uint64_t kLargestQuickFan = 1000;

}  // namespace forceshade::mesh
