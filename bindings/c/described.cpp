// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/described.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "forceshade/meshes.h"
#include "rendering/heights/coefficients.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::c {
namespace {

template <class Field>
std::variant<Subject, ParameterError> subject_of(std::variant<Field, ParameterError> built, const Description& description,
                                                 bool is_regular = true) {
  if (const auto* error = std::get_if<ParameterError>(&built)) return *error;
  const auto& field = std::get<Field>(built);
  return Subject{identity_of(description), field, renderer_of(field), description.damping, is_regular};
}

}  // namespace

std::vector<std::string_view> shading_names() {
  std::vector<std::string_view> names(mesh::kShadingNames.begin(), mesh::kShadingNames.end());
  std::erase(names, name_of(mesh::Shading::texture_scheme));
  return names;
}

Description described(height::Grid samples, height::Mode mode, float stiffness, const Monitor& monitor) {
  std::ranges::transform(samples.values, samples.values.begin(), heights::without_tiny);
  if (samples.interpolant == height::Interpolant::cubic_spline) {
    heights::make_coefficients(samples.values, samples.columns, samples.rows, samples.edge, monitor);
    std::ranges::transform(samples.values, samples.values.begin(), heights::without_tiny);
  }
  HeightMap map;
  map.parts.emplace_back().shape = std::make_shared<const height::Grid>(std::move(samples));
  return {"samples", DescribedHeightMap{std::move(map), mode, stiffness}};
}

std::string refusal_of(const mesh::CheckedMesh& triangles, mesh::Shading shading, mesh::Contact contact) {
  const auto undefined = undefined_of(triangles, shading, contact);
  return undefined ? std::string(undefined->key) + ": " + undefined->words() : std::string();
}

Description described(const mesh::CheckedMesh& triangles, std::optional<mesh::Sides> sides, mesh::Shading shading,
                      mesh::Contact contact, double crease, float stiffness, mesh::Materials materials) {
  MeshRendering rendering{.checked = triangles,
                          .sides = sides ? *sides : mesh::usual_sides(triangles),
                          .shading = shading,
                          .stiffness = stiffness,
                          .contact = contact,
                          .materials = std::move(materials)};
  if (rendering.has_corner_normals()) rendering.normals = mesh::corner_normals(triangles, crease).normals;
  return {"triangles", std::move(rendering)};
}

std::variant<Subject, ParameterError> build(const Description& description) {
  expect_still(description);
  if (const auto* law = std::get_if<DescribedLaw>(&description.what))
    return subject_of(fast::Law::build(law->law, law->parameters), description);
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return subject_of(fast::HeightMapField::build(map->map, map->mode, map->stiffness), description);
  const auto& mesh = std::get<MeshRendering>(description.what);
  auto built = subject_of(fast::GodObject::build(mesh), description, mesh.checked.is_regular());
  if (auto* const its = std::get_if<Subject>(&built)) its->limits_damping = has_own_damping(mesh.materials);
  return built;
}

}  // namespace forceshade::c
