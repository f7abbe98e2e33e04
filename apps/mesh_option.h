// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --mesh FILE, which stands for a law, and the options that say how it is rendered.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "rendering/identity/mesh_identity.h"
#include "rendering/meshes/check.h"
#include "rendering/meshes/load.h"

namespace forceshade::apps {

// The unit of a word of --unit, which is one of mesh::kUnitNames. Throws BadInput for any other.
mesh::Unit unit_named(const std::string& word);

// A mesh file and how it is rendered, in the words of the options.
struct MeshChoice {
  std::string file, unit;
  std::string sides = {};    // front, both, or empty: front where the mesh is closed, both where it is not
  std::string shading = {};  // vertex, edge, none, texture:FILE, or empty: what is usual beside the contact rule
  std::string contact = std::string(name_of(mesh::kUsualContact));  // a word of mesh::kContactNames
  double crease_degrees = 180;
  std::optional<float> texture_scale = std::nullopt;  // mm, of texture:FILE
  bool is_self_intersecting = false;
};

// What can be rendered on both sides. stiffness: N/mm. Throws BadInput or mesh::Error with the file, its line or faces, and
// what was expected.
MeshRendering read_mesh(const MeshChoice& choice, float stiffness);

class MeshOption {
 public:
  // From then on the command takes either: --law, --radius and --width are refused beside it.
  MeshOption(CLI::App& command, LawOptions& law);

  bool is_given() const { return !mesh_.file.empty(); }

  // Display name; not part of the identity.
  std::string name() const;

  // What holds, as the keys and values of a subject file; where it was not given, what holds unless said.
  // with_folders: files are named with their folders, else without.
  std::vector<std::pair<std::string, std::string>> entries(bool with_folders = false) const;

  // read_mesh() of the options.
  MeshRendering read(float stiffness) const;

 private:
  MeshChoice mesh_;
};

}  // namespace forceshade::apps
