// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/schemes/edge_scheme.h"

#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {
namespace {

// n/|n|, each component rounded.
Vector rounded_unit(const Triangle& triangle) {
  Vector unit;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Integer& n = triangle.normal[axis];
    const Integer size = integer_of(nearest_binary32_root({n * n, triangle.normal_squared}, 0), kFloatScale);
    unit[axis] = n < 0 ? Integer(-size) : size;
  }
  return unit;
}

}  // namespace

EdgeScheme::EdgeScheme(const Surface& surface) : surface_(surface) {
  for (const Triangle& triangle : surface.triangles()) {
    normals_.push_back(rounded_unit(triangle));
    lengths_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Integer& squared = surface.edges()[triangle.edges[i]].length_squared;
      lengths_.back()[i] = integer_of(nearest_binary32_root({squared, 1}, -kLengthScale), kFloatScale);
    }
  }
}

// With N0i = N0 + Ni for the neighbour at side i, and x_i the distance of r from the line of side i, N is the sum of x_i times
// the two N0j of the other sides. x_i is in the ratio of the weight of the corner opposite to side i, over the side's length.
Direction EdgeScheme::direction(const Rest& rest) const {
  const SurfacePoint& r = rest.r;
  if (r.feature.place != mesh::Place::triangle) return std::nullopt;
  const std::size_t index = r.feature.index;
  std::array<Vector, 3> mixed;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<std::size_t>& both = surface_.edges()[surface_.triangles()[index].edges[i]].triangles;
    const std::size_t neighbour = both.front() == index ? both.back() : both.front();  // at the rim the triangle itself
    mixed[i] = normals_[index] + normals_[neighbour];
  }
  const auto& [beta, gamma] = r.parameter;                                                           // over one denominator
  const std::array<Integer, 3> weights{gamma.over, beta.under - beta.over - gamma.over, beta.over};  // opposite to side 0, 1, 2
  Vector N{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    N = N + weights[i] * lengths_[index][j] * lengths_[index][k] * (mixed[j] + mixed[k]);
  }
  return is_zero(N) ? normals_[index] : N;
}

}  // namespace forceshade::reference::meshes
