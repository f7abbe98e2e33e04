// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/mesh_option.h"

#include <algorithm>
#include <filesystem>

#include "forceshade/apps/options.h"
#include "forceshade/meshes/facts.h"
#include "forceshade/meshes/normals.h"

namespace forceshade::apps {
namespace {

template <class Value, std::size_t N>
Value value_named(const std::string& word, const std::array<std::string_view, N>& names) {
  return static_cast<Value>(std::find(names.begin(), names.end(), word) - names.begin());
}

}  // namespace

mesh::Unit unit_named(const std::string& word) {
  const auto unit = value_named<mesh::Unit>(word, mesh::kUnitNames);
  if (static_cast<std::size_t>(unit) < mesh::kUnitNames.size()) return unit;
  throw BadInput("--unit: expected mm, m or in, got \"" + word + '"');
}

MeshOption::MeshOption(CLI::App& command, LawOptions& law) {
  CLI::Option* option =
      command.add_option("--mesh", file_, "instead of a law: a triangle mesh, an OBJ, OFF, PLY or STL file (docs/meshes.md)")
          ->type_name("FILE");
  law.allow_instead(option);
  add_word(command, "--unit", unit_, "of a mesh's coordinates, which no format says", {"mm", "m", "in"})->needs(option);
  add_word(command, "--sides", sides_, "of a mesh that block motion; front where it is closed, else both, unless said",
           {"front", "both"})
      ->needs(option);
  add_word(command, "--shading", shading_,
           "of a mesh: vertex turns the force to the interpolated normal, edge as the thesis has it",
           {"vertex", "edge", "none"})
      ->needs(option);
  add_angle(command, "--crease", "of a mesh: an edge that turns by more is not shaded over", {0, 180}, [this](double degrees) {
    crease_degrees_ = degrees;
  })->needs(option);
}

std::string MeshOption::name() const {
  return std::filesystem::path(file_).filename();
}

properties::MeshRendering MeshOption::read(float stiffness) const {
  if (unit_.empty()) throw BadInput("--unit is required beside --mesh: expected mm, m or in, for no mesh file says its unit");
  return read_mesh(file_, unit_named(unit_), stiffness, sides_, shading_, crease_degrees_);
}

properties::MeshRendering read_mesh(const std::string& file, mesh::Unit unit, float stiffness, const std::string& sides_of_it,
                                    const std::string& shading, double crease_degrees) {
  auto checked = mesh::check(mesh::load(file, unit));
  if (const auto* findings = std::get_if<mesh::Findings>(&checked))
    throw BadInput(file + ": cannot be rendered:\n" + findings->words() + "\n'forceshade mesh repair' mends some of this");
  const auto& found = std::get<mesh::CheckedMesh>(checked);
  properties::MeshRendering rendering{found.mesh(), {}, {}, {}, stiffness};
  const std::string sides = sides_of_it.empty() ? (mesh::facts_of(found).is_closed() ? "front" : "both") : sides_of_it;
  rendering.sides = value_named<mesh::Sides>(sides, mesh::kSidesNames);
  rendering.shading = value_named<mesh::Shading>(shading, mesh::kShadingNames);
  if (rendering.shading == mesh::Shading::vertex_scheme)
    rendering.normals = mesh::corner_normals(found, crease_degrees).normals;
  return rendering;
}

}  // namespace forceshade::apps
