// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The meshes and paths of the god-object's benchmark.

#include <array>
#include <string>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::bench {

struct MeshWorkload {
  std::string name;
  mesh::TriangleMesh mesh;
  std::vector<std::array<float, 3>> approach, contact, free;  // mm, one a tick
};

inline constexpr double kMeshStiffness = 0.5;  // N/mm
inline constexpr double kTick = 1e-3;          // s

// A sphere of R = 50 mm: an icosahedron, each face cut into f² triangles, 20 f² in all, and pushed out. The path winds around
// it, 0.5 to 2 mm deep.
MeshWorkload sphere_workload(int f, std::size_t contact_ticks, std::size_t free_ticks);

// A plane of ±50 mm in n x n cells of two triangles, with the ridge of the thesis, R = 15.24 mm and w = 25.4 mm, across it. The
// path goes to and fro over the ridge, 1 to 2 mm deep.
MeshWorkload bump_workload(int n, std::size_t contact_ticks, std::size_t free_ticks);

// A floor of ±20 mm in n x n cells of two triangles, and a wall of two triangles through it, which crosses the cells aslant.
// The path stays 1 mm below the floor: beside the wall, or along it and 1 to 2 mm behind it.
MeshWorkload crossing_workload(int n, bool is_along_wall, std::size_t contact_ticks);

}  // namespace forceshade::bench
