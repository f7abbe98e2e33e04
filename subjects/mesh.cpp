// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/mesh.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "files/printable.h"
#include "files/quantity.h"
#include "forceshade/heights.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/load.h"
#include "rendering/meshes/texture.h"
#include "subjects/height_map.h"
#include "subjects/materials.h"
#include "subjects/words.h"
#include "text/number_text.h"

namespace forceshade::subjects {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualCrease = 180;  // degrees

template <class Value, std::size_t N>
Value value_named(const std::string& word, const std::array<std::string_view, N>& names) {
  return static_cast<Value>(std::find(names.begin(), names.end(), word) - names.begin());
}

mesh::Shading shading_named(const std::string& word) {
  return value_named<mesh::Shading>(word.substr(0, word.find(':')), mesh::kShadingNames);  // texture:FILE is texture
}

std::string contact_of(const Options& options) {
  return options.has("contact") ? options.value("contact") : std::string(name_of(mesh::kUsualContact));
}

// A rule that uses corner normals shades already.
std::string shading_of(const Options& options) {
  if (options.has("shading")) return options.value("shading");
  const auto contact = value_named<mesh::Contact>(contact_of(options), mesh::kContactNames);
  return std::string(name_of(has_corner_normals(contact) ? mesh::Shading::none : mesh::Shading::vertex_scheme));
}

double crease_degrees(const Options& options) {
  if (!options.has("crease")) return kUsualCrease;
  const std::string name = options.name("crease"), text = options.value("crease");
  const double degrees = files::parse_angle(name, text);
  if (degrees >= 0 && degrees <= kUsualCrease) return degrees;
  throw Error(name + ": expected an angle from 0 to 180 degrees, got \"" + text + '"');
}

// Only corner normals know of a crease. The usual one is in files of versions that wrote it beside every mesh.
void expect_crease_to_count(const Options& options, mesh::Shading shading, mesh::Contact contact) {
  if (!options.has("crease") || has_corner_normals(shading) || has_corner_normals(contact)) return;
  if (crease_degrees(options) == kUsualCrease) return;
  throw Error(options.name("crease") + ": has no effect with the shading " + std::string(name_of(shading)) +
              " and the contact " + std::string(name_of(contact)) +
              "; expected the shading vertex or texture:FILE, or the contact sub-goal, beside it");
}

void expect_defined(const Options& options, const MeshRendering& rendering) {
  if (const auto undefined = undefined_of(rendering.checked, rendering.shading, rendering.contact))
    throw Error(options.name(std::string(undefined->key)) + ": " + undefined->words() +
                "; 'forceshade mesh check' says what it is");
}

std::string words_of_friction(const Options& options) {
  const mesh::Material material = parse_friction(options.name("friction"), options.value("friction"));
  return shortest(material.static_friction) + ',' + shortest(material.dynamic_friction);
}

// Millimetres, exact: a number of a point of the texture is rounded after it was multiplied with them.
std::optional<files::Decimal> texture_scale(const Options& options) {
  if (!options.has("texture-scale")) return std::nullopt;
  const std::string name = options.name("texture-scale"), text = options.value("texture-scale");
  const files::Decimal scale = files::exact_length(name, text);
  const auto nearest = scale.nearest<float>();
  if (nearest >= 0.001F && nearest <= 10000) return scale;
  throw Error(name + ": expected a length of 0.001 to 10000 mm, got \"" + text + '"');
}

mesh::CheckedMesh checked(const Options& options, Unchecked& unchecked, const Monitor& monitor) {
  const std::string file = options.value(options.has("scene") ? "scene" : "mesh");
  const auto result = [&] {
    try {
      return mesh::check_any(std::move(unchecked.loaded.mesh), monitor);
    } catch (const Interrupted&) {
      throw Interrupted("the check of " + fs::path(file).filename().string() + " was not finished");
    }
  }();
  if (const auto* found = std::get_if<mesh::CheckedMesh>(&result)) return *found;
  const auto& findings = std::get<mesh::Findings>(result);
  throw Error(files::printable(file) + ": cannot be rendered:\n" + unchecked.words(findings) +
                  "'forceshade mesh repair' mends some of this",
              Error::Lines::several);
}

void read_texture(const Options& options, const std::vector<std::array<mesh::TexturePoint, 3>>& points,
                  MeshRendering& rendering) {
  const std::string mesh_file = options.value("mesh");
  if (points.empty())
    throw Error(mesh_file +
                ": has no texture coordinates at some or all corners; expected them beside --shading texture:FILE: vt of an "
                "OBJ file, s and t or u and v or texcoord of a PLY file, or ST of an OFF file");
  if (!options.has("texture-scale"))
    throw Error(
        "--texture-scale is required beside --shading texture:FILE: expected the length of one unit of the texture "
        "coordinates, such as 1mm, for no mesh file says it");
  const std::string file = options.value("shading").substr(kTexturePrefix.size());
  heights::Spec spec = heights::read_spec(file);
  expect_valid(file, spec);
  if (!spec.map.surface.empty())
    throw Error(file + ": has a surface to measure the depth from; expected none, for the depth is that of the mesh");
  rendering.texture.map = std::move(spec.map);
  try {
    rendering.texture.corners = mesh::corner_textures(rendering.checked, points, crease_degrees(options));
  } catch (const std::invalid_argument& error) {
    throw Error(mesh_file + ": cannot be textured: " + error.what());
  }
}

}  // namespace

mesh::Unit unit_named(const std::string& word, const std::string& name) {
  const auto unit = value_named<mesh::Unit>(word, mesh::kUnitNames);
  if (static_cast<std::size_t>(unit) < mesh::kUnitNames.size()) return unit;
  throw Error(name + ": expected mm, cm, m or in, got \"" + word + '"');
}

mesh::Contact contact_beside(const mesh::Materials& materials, const Options& options) {
  const auto named = value_named<mesh::Contact>(contact_of(options), mesh::kContactNames);
  if (!has_friction(materials)) return named;
  const std::string_view source = options.has("scene") ? "scene" : options.has("friction") ? "friction" : "materials";
  if (options.has("contact") && named != mesh::Contact::friction)
    throw Error(options.name("contact") + ": expected friction, or no coefficient above 0 of " + options.name(source) +
                ", got \"" + options.value("contact") + '"');
  return mesh::Contact::friction;
}

MeshRendering rendered(const Options& options, float stiffness, const std::function<Unchecked()>& load,
                       const Monitor& monitor) {
  if (const auto error = error_of_stiffness(stiffness)) throw Error(words_of(*error, options));
  const double crease = crease_degrees(options);
  const bool has_scale = texture_scale(options).has_value();
  Unchecked unchecked = load();
  mesh::Materials& materials = unchecked.materials;
  const mesh::Contact contact = contact_beside(materials, options);
  MeshRendering rendering{checked(options, unchecked, monitor)};
  rendering.stiffness = stiffness;
  rendering.sides = options.has("sides") ? value_named<mesh::Sides>(options.value("sides"), mesh::kSidesNames)
                                         : mesh::usual_sides(rendering.checked);
  rendering.shading = shading_named(shading_of(options));
  rendering.contact = contact;
  expect_defined(options, rendering);
  expect_crease_to_count(options, rendering.shading, contact);
  rendering.materials = std::move(materials);
  if (rendering.has_corner_normals()) rendering.normals = mesh::corner_normals(rendering.checked, crease).normals;
  if (is_texture(shading_of(options)))
    read_texture(options, unchecked.loaded.texture, rendering);
  else if (has_scale)
    throw Error(options.name("texture-scale") + ": expected the shading texture:FILE beside it, got " + shading_of(options));
  return rendering;
}

MeshRendering read_mesh(const Options& options, float stiffness, const Monitor& monitor) {
  if (!options.has("unit"))
    throw Error("--unit is required beside --mesh: expected mm, cm, m or in, for no mesh file says its unit");
  const auto load = [&]() -> Unchecked {
    mesh::LoadedMesh loaded = mesh::load_in_units(
        options.value("mesh"), {unit_named(options.value("unit")), texture_scale(options).value_or(files::Decimal(1))});
    mesh::Materials materials = read_materials(options, loaded);
    const auto words = [lines = std::move(loaded.lines)](const mesh::Findings& findings) { return findings.words(lines); };
    return {std::move(loaded), std::move(materials), words};
  };
  return rendered(options, stiffness, load, monitor);
}

std::vector<std::pair<std::string, std::string>> written_mesh(const Options& options, bool with_folders) {
  const auto file_name = [&](const std::string& path) { return with_folders ? path : fs::path(path).filename().string(); };
  const std::string shading = shading_of(options), contact = contact_of(options);
  const auto scale = texture_scale(options);
  const bool has_crease = has_corner_normals(shading_named(shading)) ||
                          has_corner_normals(value_named<mesh::Contact>(contact, mesh::kContactNames));
  return {{"mesh", file_name(options.value("mesh"))},
          {"unit", options.value("unit")},
          {"sides", options.value("sides")},
          {"shading",
           is_texture(shading) ? std::string(kTexturePrefix) + file_name(shading.substr(kTexturePrefix.size())) : shading},
          {"contact", contact == name_of(mesh::kUsualContact) ? "" : contact},
          {"friction", options.has("friction") ? words_of_friction(options) : ""},
          {"materials", file_name(options.value("materials"))},
          {"texture-scale", scale ? scale->text() + "mm" : ""},
          {"crease", has_crease ? shortest(crease_degrees(options)) + "deg" : ""}};
}

}  // namespace forceshade::subjects
