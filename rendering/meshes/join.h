// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Borders that are joined within a length.

#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"
#include "rendering/meshes/distances.h"

namespace forceshade::mesh {

struct Join {
  struct Split {  // of a triangle, at a vertex beside the inside of its edge
    std::uint32_t triangle, vertex;
    SquaredDistance distance;
  };

  std::vector<std::uint32_t> onto;  // of each vertex: itself, or the one that it is moved onto
  std::vector<Triangle> triangles;  // afterwards
  std::vector<std::uint32_t> of;    // of each of these, the triangle that it is a part of
  std::vector<Split> splits;
};

// The mesh has triangles with an area alone, and no two vertices with equal coordinates. length: mm, 2^-30 at least. Throws
// std::invalid_argument with the reason, and with faces by `number`, where a face or a part of it would lose its area or turn
// by a right angle or more.
Join join_borders(const TriangleMesh& mesh, float length, const std::vector<std::uint32_t>& number);

}  // namespace forceshade::mesh
