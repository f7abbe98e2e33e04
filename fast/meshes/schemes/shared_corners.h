// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Schemes that give a direction at each corner of each triangle and interpolate: where these directions are shared, and how one
// goes over into another on an edge where they are not (docs/god-object.md).

#include "fast/meshes/rounded.h"
#include "fast/meshes/schemes/direction.h"

namespace forceshade::fast::meshes {

// The mean of what `vector_of` gives at each of the corners, times the sum of the weights.
template <class N, std::size_t kCount, class VectorOf>
FORCESHADE_INLINE Vector3<N> weighted_sum(const std::array<HalfEdge, kCount>& corners, const std::array<N, kCount>& weight,
                                          const VectorOf& vector_of) noexcept {
  if constexpr (kCount == 3) {
    const Vector3<N> first = point<N>(vector_of(corners[0]).data()), second = point<N>(vector_of(corners[1]).data()),
                     third = point<N>(vector_of(corners[2]).data()), weights{weight[0], weight[1], weight[2]};
    return Vector3<N>{dot(weights, Vector3<N>{first.x, second.x, third.x}),
                      dot(weights, Vector3<N>{first.y, second.y, third.y}),
                      dot(weights, Vector3<N>{first.z, second.z, third.z})};
  } else {
    Vector3<N> all = scaled(weight[0], point<N>(vector_of(corners[0]).data()));
    for (std::size_t i = 1; i < kCount; ++i) all = sum(all, scaled(weight[i], point<N>(vector_of(corners[i]).data())));
    return all;
  }
}

// Scheme::are_same(mesh, a, b): whether the triangles of two half-edges that start at one vertex have the same corner there.
// Scheme::interpolated(numbers, corners, weight, last): the scheme's N between these corners of a triangle, times the sum of
// their weights; empty where the numbers do not decide to what a part of it is rounded; `last` is raised to the stage of each
// part.
template <class Scheme>
struct SharedCorners {
  template <class Numbers, class N = typename Numbers::N>
  static ShadingDirection<N> outward(const Numbers& numbers, const Way3<N>& way, Stage& last) noexcept {
    const Mesh& mesh = numbers.mesh();
    const GridPoint& grid_point = numbers.grid_point();
    const auto shaded_by = [&](const std::optional<Vector3<N>>& direction) -> ShadingDirection<N> {
      return direction ? from_its_side(grid_point.side, *direction) : ShadingDirection<N>{ShadingOutcome::unknown, {}};
    };
    if (grid_point.place == mesh::Place::vertex) {
      const HalfEdge first = mesh.first_around(mesh.start(grid_point.half));
      for (HalfEdge h = mesh.around(first); h != kRim && h != first; h = mesh.around(h))
        if (!Scheme::are_same(mesh, h, first)) return {ShadingOutcome::none, {}};
      return shaded_by(Scheme::template interpolated<1>(numbers, {first}, {N::exactly(1)}, last));
    }
    if (grid_point.place == mesh::Place::triangle) {
      const HalfEdge h = grid_point.half;
      return shaded_by(Scheme::template interpolated<3>(numbers, {h, h + 1, h + 2}, numbers.weights_in_triangle(), last));
    }
    const HalfEdge other = mesh.twin(grid_point.half);
    const std::array<N, 2> weight = numbers.weights_on_edge();
    const std::array<HalfEdge, 2> ends{grid_point.half, next(grid_point.half)}, beyond{next(other), other};
    if (other == kRim || (Scheme::are_same(mesh, ends[0], beyond[0]) && Scheme::are_same(mesh, ends[1], beyond[1])))
      return shaded_by(Scheme::template interpolated<2>(numbers, ends, weight, last));
    // D = α n1 + β n2, α and β of the side's sign; they carry it to the direction.
    const Face &first = mesh.face(face_of(grid_point.half)), &second = mesh.face(face_of(other));
    if (first.fold(corner_of(grid_point.half)) == Fold::flat) return {ShadingOutcome::none, {}};
    if (!numbers.is_at_foot()) {
      const Sign along = proved_sign(dot(way.vector, numbers.edge()));
      if (along == Sign::unknown) return {ShadingOutcome::unknown, {}};
      if (along != Sign::zero) return {ShadingOutcome::none, {}};
    }
    const Vector3<N> n1 = numbers.normal(first), n2 = numbers.normal(second), axis = cross(n1, n2);
    const N alpha = dot(cross(way.vector, n2), axis), beta = dot(cross(n1, way.vector), axis);
    const Sign against = grid_point.side == mesh::Side::front ? Sign::negative : Sign::positive;
    for (const Sign sign : {proved_sign(alpha), proved_sign(beta)}) {
      if (sign == Sign::unknown) return {ShadingOutcome::unknown, {}};
      if (sign == against) return {ShadingOutcome::none, {}};
    }
    const std::optional<float> q1 = nearest_length(n1), q2 = nearest_length(n2);
    const auto first_side = Scheme::template interpolated<2>(numbers, ends, weight, last),
               second_side = Scheme::template interpolated<2>(numbers, beyond, weight, last);
    if (!q1 || !q2 || !first_side || !second_side) return {ShadingOutcome::unknown, {}};
    return {ShadingOutcome::direction, sum(scaled(alpha * N::exactly(static_cast<double>(*q1)), *first_side),
                                           scaled(beta * N::exactly(static_cast<double>(*q2)), *second_side))};
  }
};

}  // namespace forceshade::fast::meshes
