// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The texture scheme: the vertex scheme's N, tilted by the slopes of a height map that is laid over the mesh.

#include "forceshade/reference.h"
#include "reference/meshes/schemes/vertex_scheme.h"

namespace forceshade::reference::meshes {

class TextureScheme final : public SharedCorners {
 public:
  TextureScheme(const Surface& surface, mesh::CornerNormals normals, mesh::CornerTextures corners, HeightMapField map);

 protected:
  bool are_same(std::size_t first, std::size_t second, std::size_t vertex) const override;
  Vector interpolated(std::size_t triangle, const std::array<Integer, 3>& weights) const override;

 private:
  mesh::CornerNormals normals_;
  mesh::CornerTextures corners_;
  HeightMapField map_;
};

}  // namespace forceshade::reference::meshes
