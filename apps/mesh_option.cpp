// SPDX-License-Identifier: BSD-3-Clause
#include "apps/mesh_option.h"

#include <algorithm>
#include <filesystem>

#include "apps/height_map_option.h"
#include "apps/length.h"
#include "apps/mesh_input.h"
#include "apps/options.h"
#include "files/csv.h"
#include "files/printable.h"
#include "files/suggestion.h"
#include "rendering/heights/spec.h"
#include "rendering/meshes/facts.h"
#include "rendering/meshes/normals.h"
#include "rendering/meshes/texture.h"

namespace forceshade::apps {
namespace {

template <class Value, std::size_t N>
Value value_named(const std::string& word, const std::array<std::string_view, N>& names) {
  return static_cast<Value>(std::find(names.begin(), names.end(), word) - names.begin());
}

constexpr std::string_view kTexturePrefix = "texture:";

bool is_texture(const std::string& shading) {
  return shading.starts_with(kTexturePrefix) && shading.size() > kTexturePrefix.size();
}

mesh::Shading shading_named(const std::string& word) {
  return is_texture(word) ? mesh::Shading::texture_scheme : value_named<mesh::Shading>(word, mesh::kShadingNames);
}

mesh::Contact contact_of(const MeshChoice& choice) {
  return value_named<mesh::Contact>(choice.contact, mesh::kContactNames);
}

// A rule that uses corner normals shades already.
std::string shading_of(const MeshChoice& choice) {
  if (!choice.shading.empty()) return choice.shading;
  return std::string(name_of(has_corner_normals(contact_of(choice)) ? mesh::Shading::none : mesh::Shading::vertex_scheme));
}

// A name of the list, but for texture: that needs its file.
std::string refusal_of_shading(const std::string& got) {
  const bool is_name = static_cast<std::size_t>(shading_named(got)) < mesh::kShadingNames.size();
  if (is_texture(got) || (is_name && got != name_of(mesh::Shading::texture_scheme))) return {};
  return "expected one of vertex, edge, none, texture:FILE; got \"" + got + '"' +
         files::suggestion(got, {"vertex", "edge", "none", "texture:FILE"});
}

void read_texture(const MeshChoice& choice, const mesh::CheckedMesh& checked,
                  const std::vector<std::array<mesh::TexturePoint, 3>>& points, MeshRendering& rendering) {
  if (points.empty())
    throw BadInput(choice.file +
                   ": has no texture coordinates at some or all corners; expected them beside --shading texture:FILE: vt of an "
                   "OBJ file, s and t or u and v or texcoord of a PLY file, or ST of an OFF file");
  if (!choice.texture_scale)
    throw BadInput(
        "--texture-scale is required beside --shading texture:FILE: expected the length of one unit of the texture "
        "coordinates, such as 1mm, for no mesh file says it");
  const std::string file = choice.shading.substr(kTexturePrefix.size());
  heights::Spec spec = heights::read_spec(file);
  expect_valid(file, spec, 1);
  if (!spec.map.surface.empty())
    throw BadInput(file + ": has a surface to measure the depth from; expected none, for the depth is that of the mesh");
  rendering.texture.map = std::move(spec.map);
  try {
    rendering.texture.corners = mesh::corner_textures(checked, points, *choice.texture_scale, choice.crease_degrees);
  } catch (const std::invalid_argument& error) {
    throw BadInput(choice.file + ": cannot be textured: " + error.what());
  }
}

}  // namespace

mesh::Unit unit_named(const std::string& word) {
  const auto unit = value_named<mesh::Unit>(word, mesh::kUnitNames);
  if (static_cast<std::size_t>(unit) < mesh::kUnitNames.size()) return unit;
  throw BadInput("--unit: expected mm, m or in, got \"" + word + '"');
}

MeshOption::MeshOption(CLI::App& command, LawOptions& law) {
  const std::string group = command.option_defaults()->get_group();
  command.option_defaults()->group(kSubjectGroup);
  CLI::Option* option =
      command
          .add_option("--mesh", mesh_.file, "instead of a law: a triangle mesh, an OBJ, OFF, PLY or STL file (docs/meshes.md)")
          ->type_name("FILE");
  law.allow_instead(option);
  add_word(command, "--unit", mesh_.unit, "of a mesh's coordinates, which no format says", {"mm", "m", "in"})->needs(option);
  add_word(command, "--sides", mesh_.sides, "of a mesh that block motion; front where it is closed, else both, unless said",
           {"front", "both"})
      ->needs(option);
  command
      .add_option("--shading", mesh_.shading,
                  "of a mesh: vertex, which is the default, turns the force to the interpolated normal, edge as the thesis has "
                  "it, texture tilts that normal by a height map, a TOML file")
      ->type_name("vertex|edge|none|texture:FILE")
      ->check(CLI::Validator(&refusal_of_shading, ""))
      ->needs(option);
  add_word(
      command, "--contact", mesh_.contact,
      "of a mesh: in a contact the god-object goes for the position (direct), or for that as a plane would hold it which is "
      "turned to the interpolated normal (sub-goal); then --shading is none unless given",
      {mesh::kContactNames.begin(), mesh::kContactNames.end()})
      ->capture_default_str()
      ->needs(option);
  command
      .add_option_function<std::string>(
          "--texture-scale", [this](const std::string& text) { mesh_.texture_scale = parse_length("--texture-scale", text); },
          "of a textured mesh: the length of one unit of the texture coordinates in its file, which no format says")
      ->type_name("LENGTH")
      ->needs(option);
  command
      .add_flag("--self-intersecting", mesh_.is_self_intersecting,
                "of a mesh: faces without a common vertex may cross; each way is tested against the whole mesh")
      ->needs(option);
  add_angle(command, "--crease", "of a mesh: an edge that turns by more is not shaded over", {0, 180}, [this](double degrees) {
    mesh_.crease_degrees = degrees;
  })->needs(option);
  command.option_defaults()->group(group);
}

std::string MeshOption::name() const {
  return std::filesystem::path(mesh_.file).filename();
}

std::vector<std::pair<std::string, std::string>> MeshOption::entries(bool with_folders) const {
  const auto file_name = [&](const std::string& path) {
    return with_folders ? path : std::filesystem::path(path).filename().string();
  };
  return {{"mesh", file_name(mesh_.file)},
          {"unit", mesh_.unit},
          {"sides", mesh_.sides},
          {"shading", is_texture(mesh_.shading)
                          ? std::string(kTexturePrefix) + file_name(mesh_.shading.substr(kTexturePrefix.size()))
                          : shading_of(mesh_)},
          {"contact", mesh_.contact == name_of(mesh::kUsualContact) ? "" : mesh_.contact},
          {"texture-scale", mesh_.texture_scale ? files::shortest(*mesh_.texture_scale) + "mm" : ""},
          {"self-intersecting", mesh_.is_self_intersecting ? "true" : ""},
          {"crease", files::shortest(mesh_.crease_degrees) + "deg"}};
}

MeshRendering MeshOption::read(float stiffness) const {
  if (mesh_.unit.empty())
    throw BadInput("--unit is required beside --mesh: expected mm, m or in, for no mesh file says its unit");
  return read_mesh(mesh_, stiffness);
}

MeshRendering read_mesh(const MeshChoice& choice, float stiffness) {
  mesh::LoadedMesh loaded = mesh::load_with_corners(choice.file, unit_named(choice.unit));
  const auto self_intersections =
      choice.is_self_intersecting ? mesh::SelfIntersections::allowed : mesh::SelfIntersections::refused;
  auto checked = checked_with_progress(choice.file, std::move(loaded.mesh), self_intersections);
  if (const auto* findings = std::get_if<mesh::Findings>(&checked)) {
    const bool crosses = findings->counts[static_cast<std::size_t>(mesh::Fault::meeting)] > 0;
    throw BadInputOfLines(
        files::printable(choice.file) + ": cannot be rendered:\n" + findings->words(loaded.lines) +
        "'forceshade mesh repair' mends some of this" +
        (crosses && !choice.is_self_intersecting ? "; with --self-intersecting, faces without a common vertex may cross" : ""));
  }
  const auto& found = std::get<mesh::CheckedMesh>(checked);
  MeshRendering rendering{found};
  rendering.stiffness = stiffness;
  const std::string sides = choice.sides.empty() ? (mesh::facts_of(found).is_closed() ? "front" : "both") : choice.sides;
  rendering.sides = value_named<mesh::Sides>(sides, mesh::kSidesNames);
  rendering.shading = shading_named(shading_of(choice));
  rendering.contact = contact_of(choice);
  if (rendering.has_corner_normals()) rendering.normals = mesh::corner_normals(found, choice.crease_degrees).normals;
  if (rendering.shading == mesh::Shading::texture_scheme)
    read_texture(choice, found, loaded.texture, rendering);
  else if (choice.texture_scale)
    throw BadInput("--texture-scale is for --shading texture:FILE alone");
  return rendering;
}

}  // namespace forceshade::apps
