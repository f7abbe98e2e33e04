// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Paths of a god-object that another program has computed, in a folder: NAME.off, NAME.normals.csv and NAME.csv for each mesh.
// meshes.csv, where there is one, has the sides that block motion. tests/golden/README.md describes the columns. Paths with
// friction are in a folder of their own: NAME.csv and NAME.materials.csv for a mesh of the other folder.

#include <array>
#include <string>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::tests {

struct PathTick {
  std::array<float, 3> position{};  // mm, as it is in the file: NaN, infinity and values outside the domain occur
  mesh::Tick tick;                  // with the unshaded force
  std::array<float, 3> shaded{};    // N, by the vertex scheme
  std::string place;                // file and line, for messages
};

// Without meshes.csv, meshes with a rim block motion from both sides, but for one of the name "pit".
struct GodObjectPath {
  std::string name;
  mesh::TriangleMesh mesh;
  mesh::CornerNormals normals;
  mesh::Materials materials;  // one for each triangle, or none
  mesh::Sides sides = mesh::Sides::front;
  float stiffness = 0.3F;       // N/mm, of every path
  std::vector<PathTick> ticks;  // in order; the first one starts from no state
};

// The names of the paths in the folder, sorted: every NAME with a NAME.off and a NAME.csv.
std::vector<std::string> god_object_paths_in(const std::string& folder);

// Throws std::runtime_error with the file and the line of what it cannot read.
GodObjectPath read_god_object_path(const std::string& folder, const std::string& name);

// As the column `feature` has it: "v i", "e i j m", "t i k l", or "-" where it is free or nowhere.
std::string feature_text(const mesh::GodObject& state);

// The same for paths with friction, whose meshes and normals are in the folder `meshes`.
std::vector<std::string> friction_paths_in(const std::string& folder);
GodObjectPath read_friction_path(const std::string& meshes, const std::string& folder, const std::string& name);

// For messages: status, feature, side, whether it slips, moves and force.
std::string show(const mesh::Tick& tick);

// Equal in every column: states by value, forces by their bits.
bool is_same(const mesh::Tick& a, const mesh::Tick& b);

}  // namespace forceshade::tests
