// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ends of borders that are joined within a length.

#include <cstdint>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

struct Join {
  std::vector<std::uint32_t> onto;    // of each vertex: itself, or the one that it is moved onto
  std::vector<std::uint32_t> beside;  // those that are left within the length of the inside of a border's edge
};

// The mesh has triangles with an area alone, and no two vertices with equal coordinates. length: mm, 2^-30 at least. Throws
// std::invalid_argument with the reason, and with faces by `number`, where a face would lose its area or turn by a right angle
// or more.
Join join_borders(const TriangleMesh& mesh, float length, const std::vector<std::uint32_t>& number);

}  // namespace forceshade::mesh
