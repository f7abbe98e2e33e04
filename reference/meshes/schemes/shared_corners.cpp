// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/schemes/shared_corners.h"

#include <algorithm>

#include "reference/meshes/rounding.h"

namespace forceshade::reference::meshes {

using mesh::Place;

Direction SharedCorners::direction(const Rest& rest) const {
  const std::size_t index = rest.r.feature.index;
  if (rest.r.feature.place == Place::edge) return on_edge(surface_.edges()[index], rest);
  if (rest.r.feature.place == Place::vertex) return at_vertex(index);
  const auto& [beta, gamma] = rest.r.parameter;  // over one denominator, as foot() and exactly() give them
  return interpolated(index, {beta.under - beta.over - gamma.over, beta.over, gamma.over});
}

std::size_t SharedCorners::corner(std::size_t triangle, std::size_t vertex) const {
  const mesh::Triangle& corners = surface_.triangles()[triangle].vertices;
  return static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
}

// Times the denominator of t.
Vector SharedCorners::along_edge(const Edge& edge, std::size_t triangle, const Fraction& t) const {
  std::array<Integer, 3> weights{};
  weights[corner(triangle, edge.vertices[0])] = t.under - t.over;
  weights[corner(triangle, edge.vertices[1])] = t.over;
  return interpolated(triangle, weights);
}

Direction SharedCorners::on_edge(const Edge& edge, const Rest& rest) const {
  const Fraction& t = rest.r.parameter[0];
  const std::size_t first = edge.triangles.front(), second = edge.triangles.back();
  if (std::ranges::all_of(edge.vertices, [&](std::uint32_t v) { return are_same(first, second, v); }))
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
Integer SharedCorners::length(std::size_t triangle) const {
  return integer_of(nearest_binary32_root({surface_.triangles()[triangle].normal_squared, 1}, -2 * kLengthScale), kFloatScale);
}

Direction SharedCorners::at_vertex(std::size_t vertex) const {
  const std::vector<std::size_t>& triangles = surface_.fan(vertex).triangles;
  const std::size_t first = triangles.front();
  if (!std::ranges::all_of(triangles, [&](std::size_t i) { return are_same(i, first, vertex); })) return std::nullopt;
  std::array<Integer, 3> weights{};
  weights[corner(first, vertex)] = 1;
  return interpolated(first, weights);
}

}  // namespace forceshade::reference::meshes
