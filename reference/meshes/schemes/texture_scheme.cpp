// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/schemes/texture_scheme.h"

#include <utility>

#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {

TextureScheme::TextureScheme(const Surface& surface, mesh::CornerNormals normals, mesh::CornerTextures corners,
                             HeightMapField map)
    : SharedCorners(surface), normals_(std::move(normals)), corners_(std::move(corners)), map_(std::move(map)) {}

bool TextureScheme::are_same(std::size_t first, std::size_t second, std::size_t vertex) const {
  const std::size_t i = corner(first, vertex), j = corner(second, vertex);
  return normals_[first][i] == normals_[second][j] && corners_[first][i] == corners_[second][j];
}

// N - l (U_x G_x + U_y G_y), each of N, G_x and G_y interpolated, l the binary32 nearest to |N|, U_x and U_y the rounded slopes
// at the rounded point of the map. All of it times the sum of the weights and 2^(3 kFloatScale).
Vector TextureScheme::interpolated(std::size_t triangle, const std::array<Integer, 3>& weights) const {
  const Integer sum = weights[0] + weights[1] + weights[2];
  Vector N{}, along_x{}, along_y{};
  std::array<Integer, 2> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    const mesh::CornerTexture& its = corners_[triangle][i];
    N = N + weights[i] * exact_vector(normals_[triangle][i]);
    along_x = along_x + weights[i] * exact_vector(its.gradient_x);
    along_y = along_y + weights[i] * exact_vector(its.gradient_y);
    for (std::size_t axis = 0; axis < 2; ++axis) at[axis] += weights[i] * integer_of(its.point[axis], kFloatScale);
  }
  const auto coordinate = [&](const Integer& over) { return nearest_binary32({over, sum}, -kFloatScale); };
  const auto [slope_x, slope_y] = map_.slopes(coordinate(at[0]), coordinate(at[1]));
  const Integer length = integer_of(nearest_binary32_root({dot(N, N), sum * sum}, -kFloatScale), kFloatScale);
  const Integer one = Integer(1) << (2 * kFloatScale);
  return one * N - length * (integer_of(slope_x, kFloatScale) * along_x + integer_of(slope_y, kFloatScale) * along_y);
}

}  // namespace forceshade::reference::meshes
