// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The meshes and paths of the god-object's benchmark.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/law.h"
#include "rendering/mesh_rendering.h"

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

// The value, or the program's end with the message.
template <class T>
T value_of(std::variant<T, ParameterError> made, const MeshWorkload& workload) {
  if (const auto* error = std::get_if<ParameterError>(&made)) {
    std::printf("%s: %s\n", workload.name.c_str(), error->message().c_str());
    std::exit(1);
  }
  return std::get<T>(std::move(made));
}

// Its mesh from the front and without shading, or the program's end with what is wrong with the mesh.
MeshRendering unshaded_rendering(const MeshWorkload& workload);

}  // namespace forceshade::bench
