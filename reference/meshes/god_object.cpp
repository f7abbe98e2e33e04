// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/meshes/god_object.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forceshade/reference/meshes/edge_scheme.h"
#include "forceshade/reference/meshes/force.h"
#include "forceshade/reference/meshes/texture_scheme.h"
#include "forceshade/reference/position.h"

namespace forceshade::reference {

struct GodObject::Parts {
  Parts(const mesh::TriangleMesh& triangles, mesh::Sides blocked, mesh::SelfIntersections allowed, float K)
      : surface(triangles), crossings(surface), sides(blocked), self_intersections(allowed), stiffness(K) {}

  std::array<float, 3> force(const meshes::Rest& rest) const {
    return scheme == nullptr ? meshes::unshaded_force(rest, stiffness)
                             : meshes::shaded_force(scheme->direction(rest), rest, stiffness);
  }

  const meshes::Surface surface;
  const meshes::Crossings crossings;
  const mesh::Sides sides;
  const mesh::SelfIntersections self_intersections;
  const float stiffness;
  std::unique_ptr<const meshes::Scheme> scheme;  // null: the force is not shaded
};

namespace {

std::optional<ParameterError> outside(const char* name, const char* unit, float value, float most) {
  if (std::fabs(value) <= most) return std::nullopt;
  return ParameterError{name, unit, value, -most, most};
}

std::optional<ParameterError> error_of_count(const char* name, std::size_t count, const mesh::TriangleMesh& mesh) {
  const auto expected = static_cast<float>(mesh.triangles.size());
  if (count == mesh.triangles.size()) return std::nullopt;
  return ParameterError{name, "", static_cast<float>(count), expected, expected};
}

std::optional<ParameterError> error_of(const mesh::CornerNormals& normals, const mesh::TriangleMesh& mesh) {
  if (const auto error = error_of_count("number of triangles with normals", normals.size(), mesh)) return error;
  for (const auto& corners : normals)
    for (const mesh::Normal& normal : corners)
      for (const float component : normal)
        if (const auto error = outside("component of a normal", "", component, 2)) return error;
  return std::nullopt;
}

std::optional<ParameterError> error_of(const mesh::CornerTextures& textures, const mesh::TriangleMesh& mesh) {
  if (const auto error = error_of_count("number of triangles with texture", textures.size(), mesh)) return error;
  for (const auto& corners : textures)
    for (const mesh::CornerTexture& corner : corners) {
      for (const float coordinate : corner.point)
        if (const auto error = outside("texture coordinate", "mm", coordinate, 10000)) return error;
      for (const mesh::Normal& gradient : {corner.gradient_x, corner.gradient_y})
        for (const float component : gradient) {
          if (const auto error = outside("gradient of a texture coordinate", "mm/mm", component, 1000)) return error;
          const float least = std::ldexp(1.0F, -30);
          if (component != 0 && std::fabs(component) < least)
            return ParameterError{"size of a gradient of a texture coordinate", "mm/mm", std::fabs(component), least, 1000};
        }
    }
  return std::nullopt;
}

std::variant<HeightMapField, ParameterError> field_of(const mesh::Texture& texture) {
  return HeightMapField::build({texture.map.parts}, height::Rendering::force_shaded, 1);
}

}  // namespace

std::variant<GodObject, ParameterError> GodObject::build(const mesh::TriangleMesh& mesh, mesh::CornerNormals normals,
                                                         mesh::Sides sides, mesh::Shading shading, float stiffness,
                                                         const mesh::Texture& texture,
                                                         mesh::SelfIntersections self_intersections) {
  if (const auto error = meshes::Surface::first_error(mesh)) return *error;
  if (const auto error = first_error(mesh, normals, shading, stiffness, texture)) return *error;
  auto parts = std::make_shared<Parts>(mesh, sides, self_intersections, stiffness);
  switch (shading) {
    case mesh::Shading::none: break;
    case mesh::Shading::vertex_scheme:
      parts->scheme = std::make_unique<meshes::VertexScheme>(parts->surface, std::move(normals));
      break;
    case mesh::Shading::edge_scheme: parts->scheme = std::make_unique<meshes::EdgeScheme>(parts->surface); break;
    case mesh::Shading::texture_scheme:
      parts->scheme = std::make_unique<meshes::TextureScheme>(parts->surface, std::move(normals), texture.corners,
                                                              std::get<HeightMapField>(field_of(texture)));
      break;
  }
  return GodObject(std::move(parts));
}

std::optional<ParameterError> GodObject::first_error(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals,
                                                     mesh::Shading shading, float stiffness, const mesh::Texture& texture) {
  if (!(stiffness >= 0.001F && stiffness <= 1000)) return ParameterError{"stiffness", "N/mm", stiffness, 0.001F, 1000};
  if (mesh::has_corner_normals(shading))
    if (const auto error = error_of(normals, mesh)) return error;
  if (shading != mesh::Shading::texture_scheme) return std::nullopt;
  if (const auto error = error_of(texture.corners, mesh)) return error;
  const auto map = field_of(texture);
  const auto* error = std::get_if<ParameterError>(&map);
  return error == nullptr ? std::nullopt : std::optional(*error);
}

mesh::Tick GodObject::step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  if (!in_domain(Eigen::Vector3f(position.data()))) return {mesh::TickStatus::invalid, 0, {}, before};
  const meshes::Descended end = meshes::descend(parts_->surface, parts_->crossings, parts_->sides, parts_->self_intersections,
                                                before, position, most_moves);
  mesh::Tick tick{end.status, static_cast<std::uint16_t>(end.moves), {}, end.after};
  if (end.rest) tick.force = parts_->force(*end.rest);
  return tick;
}

}  // namespace forceshade::reference
