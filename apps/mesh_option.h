// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --mesh FILE, which stands for a law, and the options that say how it is rendered.

#include <optional>
#include <string>

#include "forceshade/apps/command.h"
#include "forceshade/identity/mesh_identity.h"
#include "forceshade/meshes/check.h"
#include "forceshade/meshes/load.h"

namespace forceshade::apps {

// Of --unit, a word of mesh::kUnitNames. Throws BadInput for any other.
mesh::Unit unit_named(const std::string& word);

class MeshOption {
 public:
  // From then on the command takes either: --law, --radius and --width are refused beside it.
  MeshOption(CLI::App& command, LawOptions& law);

  bool is_given() const { return !file_.empty(); }

  // For people and records; no claim hangs on it.
  std::string name() const;

  // What can be rendered on both sides. Throws BadInput or mesh::Error with the file, its line or faces, and what was expected.
  properties::MeshRendering read(float stiffness) const;

 private:
  void read_texture(const mesh::CheckedMesh& checked, const std::vector<std::array<mesh::TexturePoint, 3>>& points,
                    properties::MeshRendering& rendering) const;

  std::string file_, unit_, sides_, shading_ = "vertex";
  double crease_degrees_ = 180;
  std::optional<float> texture_scale_;  // mm
};

}  // namespace forceshade::apps
