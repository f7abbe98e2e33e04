// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes that tests make, checked as every mesh is that can be rendered.

#include <stdexcept>
#include <utility>

#include "fast/meshes/mesh.h"
#include "forceshade/meshes.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::tests {

// The result of a build(). Throws its error instead.
template <class T>
T built(std::variant<T, ParameterError> result) {
  if (const auto* error = std::get_if<ParameterError>(&result)) throw std::runtime_error(error->message());
  return std::get<T>(std::move(result));
}

inline mesh::CheckedMesh checked(mesh::TriangleMesh mesh) {
  auto result = mesh::check(std::move(mesh));
  if (const auto* findings = std::get_if<mesh::Findings>(&result)) throw std::runtime_error(findings->words());
  return std::get<mesh::CheckedMesh>(std::move(result));
}

// Without shading, 1 N/mm.
inline MeshRendering unshaded(mesh::TriangleMesh mesh, mesh::Sides sides) {
  return {checked(std::move(mesh)), {}, sides, mesh::Shading::none, 1, {}};
}

inline MeshRendering shaded(mesh::TriangleMesh mesh, mesh::CornerNormals normals, mesh::Sides sides, float stiffness = 1) {
  return {checked(std::move(mesh)), std::move(normals), sides, mesh::Shading::vertex_scheme, stiffness, {}};
}

inline fast::Mesh fast_mesh(const MeshRendering& rendering) {
  return built(fast::Mesh::build(rendering));
}

}  // namespace forceshade::tests
