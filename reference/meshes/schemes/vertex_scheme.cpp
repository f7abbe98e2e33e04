// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/schemes/vertex_scheme.h"

#include <utility>

#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {

Vector exact_vector(const mesh::Normal& vector) {
  return {integer_of(vector[0], kFloatScale), integer_of(vector[1], kFloatScale), integer_of(vector[2], kFloatScale)};
}

VertexScheme::VertexScheme(const Surface& surface, mesh::CornerNormals normals)
    : SharedCorners(surface), normals_(std::move(normals)) {}

bool VertexScheme::are_same(std::size_t first, std::size_t second, std::size_t vertex) const {
  return normals_[first][corner(first, vertex)] == normals_[second][corner(second, vertex)];
}

Vector VertexScheme::interpolated(std::size_t triangle, const std::array<Integer, 3>& weights) const {
  const auto& [a, b, c] = normals_[triangle];
  return weights[0] * exact_vector(a) + weights[1] * exact_vector(b) + weights[2] * exact_vector(c);
}

}  // namespace forceshade::reference::meshes
