// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/directions.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;

// True if u's projection is strictly inside the half-plane or the sector that the triangle is at a point of its border.
bool projection_is_inside(const Triangle& triangle, const Feature& feature, const Vector& u) {
  if (feature.place == Place::edge) {
    const auto side = std::ranges::find(triangle.edges, feature.index) - triangle.edges.begin();
    return dot(triangle.inward[static_cast<std::size_t>(side)], u) > 0;
  }
  const auto corner = static_cast<std::size_t>(std::ranges::find(triangle.vertices, feature.index) - triangle.vertices.begin());
  return dot(triangle.inward[corner], u) > 0 && dot(triangle.inward[(corner + 2) % 3], u) > 0;
}

// Keeps the candidate with the largest u·v, of equal ones the first. Candidates are compared by the square of u·v with its
// sign.
class Largest {
 public:
  void offer(const Feature& along, Fraction signed_square) {
    const auto order = best_ ? signed_square <=> best_->second : std::strong_ordering::greater;
    if (order == 0) is_tied_ = true;
    if (order <= 0) return;
    best_.emplace(along, std::move(signed_square));
    is_tied_ = false;
  }
  const std::optional<std::pair<Feature, Fraction>>& best() const { return best_; }
  bool is_tied() const { return is_tied_; }

 private:
  std::optional<std::pair<Feature, Fraction>> best_;
  bool is_tied_ = false;
};

void offer_edge(Largest& largest, const Surface& surface, std::size_t index, const Vector& away, const Vector& u) {
  const Integer product = dot(u, away);
  largest.offer({Place::edge, index}, {product < 0 ? Integer(-product * product) : Integer(product * product),
                                       surface.edges()[index].length_squared});
}

DirectionKind side_of_triangle(const Triangle& triangle, const Vector& u) {
  return dot(triangle.normal, u) > 0 ? DirectionKind::front : DirectionKind::back;
}

DirectionKind side_of_edge(const Surface& surface, const Edge& edge, const Vector& u) {
  const auto is_before = [&](std::size_t i) { return dot(surface.triangles()[edge.triangles[i]].normal, u) > 0; };
  const bool is_front = edge.fold == Fold::narrow ? is_before(0) && is_before(1) : is_before(0) || is_before(1);
  return is_front ? DirectionKind::front : DirectionKind::back;
}

// v is along u's projection, where that is not 0, and there is no other way.
Directions directions_in(const Triangle& triangle, const Feature& feature, const Vector& u) {
  if (dot(triangle.normal, u).is_zero()) return {DirectionKind::on, feature, true, false};
  return {side_of_triangle(triangle, u), feature, !is_zero(cross(triangle.normal, u)), false};
}

}  // namespace

Directions directions(const Surface& surface, const Feature& feature, const Vector& u) {
  if (feature.place == Place::triangle) return directions_in(surface.triangles()[feature.index], feature, u);
  Largest largest;
  const Integer u_squared = dot(u, u);
  // Edges first, each list in order: of equal candidates the first one counts.
  if (feature.place == Place::vertex)
    for (const std::size_t i : surface.fan(feature.index).edges) {
      const Edge& edge = surface.edges()[i];
      offer_edge(largest, surface, i, edge.vertices[0] == feature.index ? edge.along : -edge.along, u);
    }
  if (feature.place == Place::edge)
    for (const Vector& away : {surface.edges()[feature.index].along, -surface.edges()[feature.index].along})
      offer_edge(largest, surface, feature.index, away, u);
  for (const std::size_t i : surface.triangles_at(feature)) {
    const Triangle& triangle = surface.triangles()[i];
    if (!projection_is_inside(triangle, feature, u)) continue;
    const Integer height = dot(triangle.normal, u);
    largest.offer({Place::triangle, i}, {u_squared * triangle.normal_squared - height * height, triangle.normal_squared});
  }
  const auto& [along, signed_square] = largest.best().value();
  const auto way = [&, along = along, square = signed_square] {
    if (square == Fraction{u_squared, 1}) return DirectionKind::on;
    if (surface.is_at_rim(feature)) return DirectionKind::open;
    return along.place == Place::edge ? side_of_edge(surface, surface.edges()[along.index], u)
                                      : side_of_triangle(surface.triangles()[along.index], u);
  };
  return {way(), along, signed_square.over > 0, largest.is_tied()};
}

}  // namespace forceshade::reference::meshes
