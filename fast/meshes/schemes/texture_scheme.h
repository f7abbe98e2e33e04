// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The texture scheme: the vertex scheme's N, tilted by the slopes of a height map that is laid over the mesh.

#include "fast/meshes/schemes/vertex_scheme.h"
#include "forceshade/fast.h"

namespace forceshade::fast::meshes {

struct TextureScheme : SharedCorners<TextureScheme> {
  static constexpr mesh::Shading kShading = mesh::Shading::texture_scheme;

  static const mesh::CornerTexture& texture_at(const Mesh& mesh, HalfEdge h) noexcept {
    return (*mesh.texture(face_of(h)))[corner_of(h)];
  }
  static bool are_same(const Mesh& mesh, HalfEdge a, HalfEdge b) noexcept {
    return VertexScheme::are_same(mesh, a, b) && texture_at(mesh, a) == texture_at(mesh, b);
  }

  template <std::size_t kCount, class Numbers, class N = typename Numbers::N>
  static std::optional<Vector3<N>> interpolated(const Numbers& numbers, const std::array<HalfEdge, kCount>& corners,
                                                const std::array<N, kCount>& weight, Stage& last) noexcept {
    const Mesh& mesh = numbers.mesh();
    const Vector3<N> smooth = *VertexScheme::interpolated(numbers, corners, weight, last);
    N all = weight[0];
    for (std::size_t i = 1; i < kCount; ++i) all = all + weight[i];
    const auto coordinate = [&](std::size_t axis) {
      const auto of = [&](std::size_t i) { return N::exactly(static_cast<double>(texture_at(mesh, corners[i]).point[axis])); };
      N over = weight[0] * of(0);
      for (std::size_t i = 1; i < kCount; ++i) over = over + weight[i] * of(i);
      return nearest_quotient(over, all);
    };
    const std::optional<float> x = coordinate(0), y = coordinate(1), size = nearest_root(square(smooth), all);
    if (!x || !y || !size) return std::nullopt;
    const auto slopes = mesh.texture_map()->slopes(*x, *y);
    if (!slopes) return std::nullopt;
    raise(last, slopes->stage);
    const auto tilt = [&](float slope, const Vector3<N>& gradient) {
      return scaled(N::exactly(static_cast<double>(*size) * static_cast<double>(slope)), gradient);  // a product of 48 bits
    };
    const Vector3<N> along_x = weighted_sum(corners, weight,
                                            [&](HalfEdge h) -> const mesh::Normal& { return texture_at(mesh, h).gradient_x; }),
                     along_y = weighted_sum(corners, weight,
                                            [&](HalfEdge h) -> const mesh::Normal& { return texture_at(mesh, h).gradient_y; });
    return smooth - sum(tilt(slopes->values[0], along_x), tilt(slopes->values[1], along_y));
  }
};

}  // namespace forceshade::fast::meshes
