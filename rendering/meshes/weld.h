// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Vertices with equal coordinates as one vertex.

#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

// A list of vertices with different coordinates, in the order in which they first came.
class Welder {
 public:
  // The place of the vertex in the list, in which it is then. No coordinate is NaN or -0.
  std::uint32_t place_of(const Vertex& vertex);

  std::vector<Vertex> take() { return std::move(vertices_); }

 private:
  static std::uint64_t hash_of(const Vertex& vertex);
  void grow();

  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> slots_;  // a power of two of them, at most half in use: 0, or 1 + a place in the list
};

// Any set of triangles as docs/soups.md sees it.

struct Welded {
  TriangleMesh mesh;  // the triangles with an area, whose vertices are the lowest used ones with their coordinates
  std::vector<std::uint32_t> number;  // that each of them had
};

// Every index is that of a vertex, and coordinates are as they were read.
Welded welded(const TriangleMesh& mesh);

}  // namespace forceshade::mesh
