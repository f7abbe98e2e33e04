// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vertex scheme: N is interpolated between the corners' normals.

#include "reference/meshes/schemes/shared_corners.h"

namespace forceshade::reference::meshes {

// A vector of binary32 numbers, times 2^kFloatScale.
Vector exact_vector(const mesh::Normal& vector);

class VertexScheme final : public SharedCorners {
 public:
  VertexScheme(const Surface& surface, mesh::CornerNormals normals);

 protected:
  bool are_same(std::size_t first, std::size_t second, std::size_t vertex) const override;
  Vector interpolated(std::size_t triangle, const std::array<Integer, 3>& weights) const override;

 private:
  mesh::CornerNormals normals_;
};

}  // namespace forceshade::reference::meshes
