// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/described.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "bindings/c/still.h"
#include "forceshade/meshes.h"
#include "rendering/heights/coefficients.h"

namespace forceshade::c {
namespace {

template <class Field>
std::variant<Subject, ParameterError> with_identity(std::variant<Field, ParameterError> built, Identity identity) {
  if (const auto* error = std::get_if<ParameterError>(&built)) return *error;
  const auto& field = std::get<Field>(built);
  return Subject{std::move(identity), field, renderer_of(field)};
}

}  // namespace

std::vector<std::string_view> shading_names() {
  std::vector<std::string_view> names(mesh::kShadingNames.begin(), mesh::kShadingNames.end());
  std::erase(names, name_of(mesh::Shading::texture_scheme));
  return names;
}

Description described(height::Grid samples, height::Mode mode, float stiffness) {
  std::ranges::transform(samples.values, samples.values.begin(), heights::without_tiny);
  if (samples.interpolant == height::Interpolant::cubic_spline) {
    heights::make_coefficients(samples.values, samples.columns, samples.rows, samples.edge);
    std::ranges::transform(samples.values, samples.values.begin(), heights::without_tiny);
  }
  HeightMap map;
  map.parts.emplace_back().shape = std::make_shared<const height::Grid>(std::move(samples));
  return {"samples", DescribedHeightMap{std::move(map), mode, stiffness}};
}

Description described(const mesh::CheckedMesh& triangles, std::optional<mesh::Sides> sides, mesh::Shading shading,
                      mesh::Contact contact, double crease, float stiffness, mesh::Materials materials) {
  const auto usual = [&] { return facts_of(triangles).is_closed() ? mesh::Sides::front : mesh::Sides::both; };
  MeshRendering rendering{.checked = triangles,
                          .sides = sides ? *sides : usual(),
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
    return with_identity(fast::Law::build(law->law, law->parameters), identity_of(description));
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return with_identity(fast::HeightMapField::build(map->map, map->mode, map->stiffness), identity_of(description));
  return with_identity(fast::GodObject::build(std::get<MeshRendering>(description.what)), identity_of(description));
}

}  // namespace forceshade::c
