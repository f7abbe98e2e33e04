// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// --mesh FILE, which stands for a law, and the options that say how it is rendered.

#include <optional>
#include <string>

#include "forceshade/apps/command.h"
#include "forceshade/identity/mesh_identity.h"
#include "forceshade/meshes/load.h"

namespace forceshade::apps {

// Of --unit, a word of mesh::kUnitNames. Throws BadInput for any other.
mesh::Unit unit_named(const std::string& word);

// A mesh that can be rendered on both sides. sides: "front", "both", or empty for front where it is closed and both where it is
// not; shading and crease as the options of these names. Throws BadInput or mesh::Error as MeshOption::read().
properties::MeshRendering read_mesh(const std::string& file, mesh::Unit unit, float stiffness, const std::string& sides = "",
                                    const std::string& shading = "vertex", double crease_degrees = 180);

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
  std::string file_, unit_, sides_, shading_ = "vertex";
  double crease_degrees_ = 180;
};

}  // namespace forceshade::apps
