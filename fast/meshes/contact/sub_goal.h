// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object of a contact inside a triangle goes for the hand's position as a plane through it would hold it that is turned
// to the interpolated normal (Ruspini, Kolarov and Khatib 1997; docs/god-object.md).

#include <algorithm>

#include "fast/domain.h"
#include "fast/meshes/contact/direct.h"
#include "fast/meshes/schemes/vertex_scheme.h"

namespace forceshade::fast {

// The comparison of a coordinate of a sub-goal with a tie, less the fractions, as SubGoal computes it.
constexpr int most_bits_of_sub_goal() noexcept {
  const Span3 shading = interpolated(kWeightSpan), &n = kFaceNormalSpan;
  const BitSpan height = dot(kWayAtGridPoint, shading), area = square(n), under = kGridSpan * (square(shading) * area);
  const BitSpan along = area * shading.x - dot(shading, n) * n.x;
  return bits_to_compare(kCoordinateSpan * under + height * along, kTieSpan * under);
}
static_assert(most_bits_of_sub_goal() <= static_cast<int>(64 * meshes::kShadedLimbs), "the wide numbers are exact");

struct SubGoal {
  static constexpr mesh::Contact kContact = mesh::Contact::sub_goal;

  template <class Stages>
  [[gnu::noinline]] static Goal move(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p,
                                     const Stages& stages) noexcept {
    const Goal goal = goal_of(mesh, at.grid_point, p, stages);
    if (!goal.is_decided) return goal;
    const GridPoint before = at.grid_point;
    walk(mesh, at, goal.is_position ? p : goal.point, stages);
    if (goal.is_position || at.grid_point.place != mesh::Place::free) return goal;
    at.grid_point = before;
    walk(mesh, at, p, stages);
    return {};
  }

 private:
  // Its places are not the usual rule's, whose code would be copied to each of them.
  template <class Stages>
  [[gnu::noinline]] static void walk(const Mesh& mesh, Arrival& at, const std::array<float, 3>& goal,
                                     const Stages& stages) noexcept {
    Direct::move(mesh, at, goal, stages);
  }

  template <class Stages>
  static Goal goal_of(const Mesh& mesh, const GridPoint& grid_point, const std::array<float, 3>& p,
                      const Stages& stages) noexcept {
    if (grid_point.place != mesh::Place::triangle) return {};
    const int behind = grid_point.side == mesh::Side::front ? -1 : 1;
    if (side_of(mesh.face(face_of(grid_point.half)), p.data(), stages) != behind) return {};
    if constexpr (Stages::kFilter) {
      const std::optional<Goal> goal = goal_in<DoubleWithError>(mesh, grid_point, p);
      if (stages.sure(goal.has_value())) return *goal;
    }
    stages.note(Stage::wide);
    return goal_in<meshes::Shaded>(mesh, grid_point, p).value_or(Goal{false});
  }

  // p + ((g - p)·N/N²) (N - (N·n/n²) n) for p behind the triangle; empty where these numbers cannot decide it.
  template <class N>
  [[gnu::noinline]] static std::optional<Goal> goal_in(const Mesh& mesh, const GridPoint& grid_point,
                                                       const std::array<float, 3>& p) noexcept {
    using meshes::scaled;
    const Arrival here{grid_point, RestKind::at_grid_point};
    const meshes::RestNumbers<N> numbers(mesh, here, HandAndGoal(p));
    const meshes::Way3<N> up = numbers.way();
    const Vector3<N> n = numbers.normal(mesh.face(face_of(grid_point.half)));
    const HalfEdge h = grid_point.half;
    Stage last{};  // nothing is rounded on the way
    const Vector3<N> shading =
        *meshes::VertexScheme::interpolated<3>(numbers, {h, h + 1, h + 2}, numbers.weights_in_triangle(), last);
    const N height = dot(up.vector, shading), area = square(n), across = dot(shading, n);
    const Sign sign = proved_sign(height);
    if (sign == Sign::unknown) return std::nullopt;
    if (sign != (grid_point.side == mesh::Side::front ? Sign::positive : Sign::negative)) return Goal{};
    const N under = up.length * (square(shading) * area);
    const Vector3<N> along = scaled(area, shading) - scaled(across, n);
    const auto over = meshes::sum(scaled(under, meshes::point<N>(p.data())), scaled(height, along));
    const auto goal = meshes::each([&](const N& one) { return meshes::nearest_quotient(one, under); }, over);
    if (!goal) return std::nullopt;
    Goal found{true, false, quantised(*goal)};
    for (float& coordinate : found.point) coordinate = std::clamp(coordinate, -kLargestCoordinate, kLargestCoordinate);
    return found;
  }
};

}  // namespace forceshade::fast
