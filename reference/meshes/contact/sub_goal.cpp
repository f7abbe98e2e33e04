// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/contact/sub_goal.h"

#include <algorithm>
#include <utility>

#include "reference/meshes/rounding.h"
#include "reference/position.h"

namespace forceshade::reference::meshes {

SubGoal::SubGoal(const Ground& ground, mesh::CornerNormals normals)
    : ground_(ground), scheme_(ground.surface, std::move(normals)) {}

// p + ((g - p)·N/N²) (N - (N·n/n²) n), over N² n².
std::optional<std::array<float, 3>> SubGoal::goal(const mesh::GodObject& before, const std::array<float, 3>& position) const {
  if (before.place != mesh::Place::triangle) return std::nullopt;
  const GridPoint at{{before.place, before.index[0]}, before.parameter};
  const Vector p = exact_point(position), up = ground_.surface.position(at) - p;
  const Triangle& triangle = ground_.surface.triangles()[before.index[0]];
  const Vector& n = triangle.normal;
  const Vector N = scheme_.direction({exactly(at), up, 1, before.side}).value();
  const Integer side = before.side == mesh::Side::front ? 1 : -1;
  if (side * dot(up, n) <= 0 || side * dot(up, N) <= 0) return std::nullopt;
  const Integer under = dot(N, N) * triangle.normal_squared;
  std::array<float, 3> goal{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Integer along = triangle.normal_squared * N[axis] - dot(N, n) * n[axis];
    const float nearest = nearest_binary32({p[axis] * under + dot(up, N) * along, under}, -kLengthScale);
    goal[axis] = quantised(std::clamp(nearest, -kDomainEnd, kDomainEnd));
  }
  return goal;
}

Descended SubGoal::move(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves) const {
  if (const auto goal = this->goal(before, position)) {
    const Descended end = descend(ground_, before, *goal, position, most_moves);
    if (end.status != Status::free) return end;
  }
  return descend(ground_, before, position, position, most_moves);
}

}  // namespace forceshade::reference::meshes
