// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vertex scheme: N is interpolated between the corners' normals.

#include "fast/meshes/schemes/shared_corners.h"

namespace forceshade::fast::meshes {

struct VertexScheme : SharedCorners<VertexScheme> {
  static constexpr mesh::Shading kShading = mesh::Shading::vertex_scheme;

  static const mesh::Normal& normal_at(const Mesh& mesh, HalfEdge h) noexcept {
    return (*mesh.normals(face_of(h)))[corner_of(h)];
  }
  static bool are_same(const Mesh& mesh, HalfEdge a, HalfEdge b) noexcept { return normal_at(mesh, a) == normal_at(mesh, b); }

  template <std::size_t kCount, class Numbers, class N = typename Numbers::N>
  FORCESHADE_INLINE static std::optional<Vector3<N>> interpolated(const Numbers& numbers,
                                                                  const std::array<HalfEdge, kCount>& corners,
                                                                  const std::array<N, kCount>& weight, Stage&) noexcept {
    return weighted_sum(corners, weight, [&](HalfEdge h) -> const mesh::Normal& { return normal_at(numbers.mesh(), h); });
  }
};

}  // namespace forceshade::fast::meshes
