// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The thesis's edge scheme (3.3) as it is printed: a triangle's normal, mixed with those of its three neighbours; inside
// triangles alone.

#include "fast/meshes/rounded.h"
#include "fast/meshes/schemes/direction.h"

namespace forceshade::fast::meshes {

struct EdgeScheme {
  static constexpr mesh::Shading kShading = mesh::Shading::edge_scheme;

  template <class Numbers, class N = typename Numbers::N>
  static ShadingDirection<N> outward(const Numbers& numbers, const Way3<N>&, Stage&) noexcept {
    const GridPoint& grid_point = numbers.grid_point();
    if (grid_point.place != mesh::Place::triangle) return {ShadingOutcome::none, {}};
    const Mesh& mesh = numbers.mesh();
    // Corner i is opposite to side i.
    const std::uint32_t f = face_of(grid_point.half);
    const auto unit_normal = [&](std::uint32_t of) -> std::optional<Vector3<N>> {
      const Vector3<N> x_axis{N::exactly(1), N::exactly(0), N::exactly(0)};
      const auto rounded = along(Way3<N>{x_axis, N::exactly(1)}, numbers.normal(mesh.face(of)), 1);
      if (!rounded) return std::nullopt;
      return point<N>(rounded->data());
    };
    const auto own = unit_normal(f);
    if (!own) return {ShadingOutcome::unknown, {}};
    const std::array<N, 3> weight = numbers.weights_in_triangle();
    std::array<Vector3<N>, 3> with_neighbour;
    std::array<N, 3> side;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfEdge h = 3 * f + after(i), other = mesh.twin(h);
      const auto neighbour = other == kRim ? own : unit_normal(face_of(other));
      const auto size = nearest_length(point<N>(mesh.start_point(next(h))) - point<N>(mesh.start_point(h)));
      if (!neighbour || !size) return {ShadingOutcome::unknown, {}};
      with_neighbour[i] = sum(*own, *neighbour);
      side[i] = N::exactly(static_cast<double>(*size));
    }
    // x_i = weight/side, times all three sides.
    Vector3<N> direction = scaled(weight[0] * (side[1] * side[2]), sum(with_neighbour[1], with_neighbour[2]));
    direction = sum(direction, scaled(weight[1] * (side[0] * side[2]), sum(with_neighbour[0], with_neighbour[2])));
    direction = sum(direction, scaled(weight[2] * (side[0] * side[1]), sum(with_neighbour[0], with_neighbour[1])));
    bool is_zero = true;
    for (const N& component : {direction.x, direction.y, direction.z}) {
      const Sign sign = proved_sign(component);
      is_zero = is_zero && sign == Sign::zero;
      if (sign == Sign::positive || sign == Sign::negative) return from_its_side(grid_point.side, direction);
    }
    return is_zero ? from_its_side(grid_point.side, *own) : ShadingDirection<N>{ShadingOutcome::unknown, {}};
  }
};

}  // namespace forceshade::fast::meshes
