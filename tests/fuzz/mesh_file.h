// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An input as a mesh file.

#include <array>
#include <cmath>
#include <vector>

#include "forceshade/meshes.h"
#include "tests/fuzz/input_file.h"

namespace forceshade::fuzz {

// The corners of every triangle, in their order.
inline std::vector<std::array<mesh::Vertex, 3>> corners_of(const mesh::TriangleMesh& mesh) {
  std::vector<std::array<mesh::Vertex, 3>> corners;
  for (const auto& [a, b, c] : mesh.triangles) corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  return corners;
}

// Loads the input as a file of this name, in each unit: what comes of it is as include/forceshade/meshes.h states, and can be
// checked and repaired.
inline int load_mesh(std::string_view bytes, const char* name) {
  const std::string file = file_of(bytes, name);
  for (const mesh::Unit unit : {mesh::Unit::mm, mesh::Unit::cm, mesh::Unit::m, mesh::Unit::in})
    read_or_refuse<Error>(file + ": ", [&] {
      const mesh::LoadedMesh loaded = mesh::load_with_corners(file, unit);
      const auto& [vertices, triangles] = loaded.mesh;
      require(!triangles.empty(), "a mesh has a triangle");
      require(loaded.normals.empty() || loaded.normals.size() == triangles.size(), "every corner has a normal, or none has");
      require(loaded.texture.empty() || loaded.texture.size() == triangles.size(), "every corner has a texture, or none has");
      for (const mesh::Vertex& vertex : vertices)
        for (const float x : vertex)
          require((x == 0 && !std::signbit(x)) || (std::fabs(x) >= 0x1p-30F && std::fabs(x) <= 1e4F),
                  "a coordinate is in its domain");
      for (const mesh::Triangle& triangle : triangles)
        for (const std::uint32_t v : triangle) require(v < vertices.size(), "an index is that of a vertex");
      if (triangles.size() > 2000) return;  // so that an input takes milliseconds
      const auto checked = mesh::check(loaded.mesh);
      if (const auto* held = std::get_if<mesh::CheckedMesh>(&checked)) {
        // Their indices may change, where a vertex that no face uses is at the place of one that a face uses.
        require(corners_of(mesh::repair(loaded.mesh).mesh) == corners_of(loaded.mesh), "repair changes no face of a mesh");
        require(mesh::corner_normals(*held, 60).normals.size() == triangles.size(), "each corner gets a normal");
      } else {
        require(!std::get<mesh::Findings>(checked).words().empty(), "what is no mesh is reported in words");
        mesh::check(mesh::repair(loaded.mesh).mesh);
      }
    });
  return 0;
}

}  // namespace forceshade::fuzz
