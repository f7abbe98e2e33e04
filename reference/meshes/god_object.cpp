// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/meshes/god_object.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "forceshade/reference/meshes/edge_scheme.h"
#include "forceshade/reference/meshes/force.h"

namespace forceshade::reference {

struct GodObject::Parts {
  Parts(const mesh::TriangleMesh& triangles, mesh::CornerNormals corner_normals, mesh::Sides blocked, mesh::Shading scheme,
        float K)
      : surface(triangles),
        crossings(surface),
        normals(std::move(corner_normals)),
        sides(blocked),
        shading(scheme),
        stiffness(K) {
    if (shading == mesh::Shading::edge_scheme) edge_scheme.emplace(surface);
  }

  std::array<float, 3> force(const meshes::Rest& rest) const {
    switch (shading) {
      case mesh::Shading::none: break;
      case mesh::Shading::vertex_scheme:
        return meshes::shaded_force(meshes::vertex_scheme_direction(surface, normals, rest), rest, stiffness);
      case mesh::Shading::edge_scheme: return meshes::shaded_force(edge_scheme->direction(rest.r), rest, stiffness);
    }
    return meshes::unshaded_force(rest, stiffness);
  }

  const meshes::Surface surface;
  const meshes::Crossings crossings;
  const mesh::CornerNormals normals;
  const mesh::Sides sides;
  const mesh::Shading shading;
  const float stiffness;
  std::optional<meshes::EdgeScheme> edge_scheme;
};

std::variant<GodObject, ParameterError> GodObject::build(const mesh::TriangleMesh& mesh, mesh::CornerNormals normals,
                                                         mesh::Sides sides, mesh::Shading shading, float stiffness) {
  if (const auto error = meshes::Surface::first_error(mesh)) return *error;
  if (const auto error = first_error(mesh, normals, shading, stiffness)) return *error;
  return GodObject(std::make_shared<const Parts>(mesh, std::move(normals), sides, shading, stiffness));
}

std::optional<ParameterError> GodObject::first_error(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals,
                                                     mesh::Shading shading, float stiffness) {
  if (!(stiffness >= 0.001F && stiffness <= 1000)) return ParameterError{"stiffness", "N/mm", stiffness, 0.001F, 1000};
  if (shading != mesh::Shading::vertex_scheme) return std::nullopt;
  const auto count = static_cast<float>(mesh.triangles.size());
  if (normals.size() != mesh.triangles.size())
    return ParameterError{"number of triangles with normals", "", static_cast<float>(normals.size()), count, count};
  for (const auto& corners : normals)
    for (const mesh::Normal& normal : corners)
      for (const float component : normal)
        if (!(std::fabs(component) <= 2)) return ParameterError{"component of a normal", "", component, -2, 2};
  return std::nullopt;
}

mesh::Tick GodObject::step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  const auto is_in_domain = [](float coordinate) { return coordinate >= -10000 && coordinate <= 10000; };
  if (!std::ranges::all_of(position, is_in_domain)) return {mesh::TickStatus::invalid, 0, {}, before};
  const meshes::Descended end =
      meshes::descend(parts_->surface, parts_->crossings, parts_->sides, before, position, most_moves);
  mesh::Tick tick{end.status, static_cast<std::uint16_t>(end.moves), {}, end.after};
  if (end.rest) tick.force = parts_->force(*end.rest);
  return tick;
}

}  // namespace forceshade::reference
