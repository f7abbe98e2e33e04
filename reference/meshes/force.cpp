// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/meshes/force.h"

#include <algorithm>
#include <cmath>

#include "forceshade/reference/meshes/rounding.h"

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;

Vector exact_normal(const mesh::Normal& normal) {
  return {integer_of(normal[0], kFloatScale), integer_of(normal[1], kFloatScale), integer_of(normal[2], kFloatScale)};
}

class VertexScheme {
 public:
  VertexScheme(const Surface& surface, const mesh::CornerNormals& normals) : surface_(surface), normals_(normals) {}

  // N but for its length, and as it is seen from in front; none where the scheme gives none.
  Direction direction(const Rest& rest) const {
    const std::size_t index = rest.r.feature.index;
    if (rest.r.feature.place == Place::triangle) return in_triangle(index, rest.r.parameter);
    if (rest.r.feature.place == Place::edge) return on_edge(surface_.edges()[index], rest);
    return at_vertex(index);
  }

 private:
  const mesh::Normal& corner_normal(std::size_t triangle, std::size_t vertex) const {
    const mesh::Triangle& corners = surface_.triangles()[triangle].vertices;
    return normals_[triangle][static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin())];
  }

  Vector in_triangle(std::size_t index, const std::array<Fraction, 2>& parameter) const {
    const auto& [beta, gamma] = parameter;  // over one denominator, as foot() and exactly() give them
    const auto& [a, b, c] = normals_[index];
    return (beta.under - beta.over - gamma.over) * exact_normal(a) + beta.over * exact_normal(b) + gamma.over * exact_normal(c);
  }

  // A triangle's normals at an edge's ends, interpolated; times the denominator of t.
  Vector along_edge(const Edge& edge, std::size_t triangle, const Fraction& t) const {
    return (t.under - t.over) * exact_normal(corner_normal(triangle, edge.vertices[0])) +
           t.over * exact_normal(corner_normal(triangle, edge.vertices[1]));
  }

  Direction on_edge(const Edge& edge, const Rest& rest) const {
    const Fraction& t = rest.r.parameter[0];
    const std::size_t first = edge.triangles.front(), second = edge.triangles.back();
    if (std::ranges::all_of(edge.vertices,
                            [&](std::uint32_t v) { return corner_normal(first, v) == corner_normal(second, v); }))
      return along_edge(edge, first, t);
    // D = alpha n1 + beta n2, both weights times |n1 x n2|² and the denominator of D.
    const bool is_behind = rest.side == mesh::Side::back;
    const Vector& n1 = surface_.triangles()[first].normal;
    const Vector& n2 = surface_.triangles()[second].normal;
    const Vector across = cross(n1, n2);
    const Vector D = is_behind ? -rest.D_over : rest.D_over;
    if (is_zero(across) || !dot(D, across).is_zero()) return std::nullopt;
    const Integer alpha = dot(cross(D, n2), across), beta = dot(cross(n1, D), across);
    if (alpha < 0 || beta < 0) return std::nullopt;
    return alpha * length(first) * along_edge(edge, first, t) + beta * length(second) * along_edge(edge, second, t);
  }

  // The binary32 nearest to |n| mm², as an integer.
  Integer length(std::size_t triangle) const {
    return integer_of(nearest_binary32_root({surface_.triangles()[triangle].normal_squared, 1}, -2 * kLengthScale),
                      kFloatScale);
  }

  Direction at_vertex(std::size_t vertex) const {
    const std::vector<std::size_t>& triangles = surface_.fan(vertex).triangles;
    const mesh::Normal& normal = corner_normal(triangles.front(), vertex);
    if (std::ranges::any_of(triangles, [&](std::size_t i) { return corner_normal(i, vertex) != normal; })) return std::nullopt;
    return exact_normal(normal);
  }

  const Surface& surface_;
  const mesh::CornerNormals& normals_;
};

}  // namespace

std::array<float, 3> unshaded_force(const Rest& rest, float stiffness) {
  const Integer K = integer_of(stiffness, kFloatScale);
  std::array<float, 3> force{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    force[axis] = nearest_binary32({K * rest.D_over[axis], rest.D_under}, -kFloatScale - kLengthScale);
  return force;
}

Direction vertex_scheme_direction(const Surface& surface, const mesh::CornerNormals& normals, const Rest& rest) {
  return VertexScheme(surface, normals).direction(rest);
}

std::array<float, 3> shaded_force(const Direction& seen_from_front, const Rest& rest, float stiffness) {
  if (!seen_from_front) return unshaded_force(rest, stiffness);
  const Vector N = rest.side == mesh::Side::back ? -*seen_from_front : *seen_from_front;
  if (dot(N, rest.D_over) <= 0) return unshaded_force(rest, stiffness);
  // The square of a component is K² |D|² N_i² / |N|².
  const Integer K = integer_of(stiffness, kFloatScale);
  const Integer size_over = K * K * dot(rest.D_over, rest.D_over), under = rest.D_under * rest.D_under * dot(N, N);
  std::array<float, 3> force{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float size = nearest_binary32_root({size_over * N[axis] * N[axis], under}, -kFloatScale - kLengthScale);
    force[axis] = N[axis] < 0 && size != 0 ? -size : size;
  }
  return force;
}

}  // namespace forceshade::reference::meshes
