// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reference/meshes/rounding.h"
#include "reference/position.h"

namespace forceshade::reference::meshes {
namespace {

using Ends = std::array<std::uint32_t, 2>;

Ends sorted(std::uint32_t a, std::uint32_t b) {
  return a < b ? Ends{a, b} : Ends{b, a};
}

Fold fold_of(const Integer& height) {
  return height > 0 ? Fold::narrow : height < 0 ? Fold::wide : Fold::flat;
}

// Sides are multiples of 2^24 units, so that the division is exact.
Vector grid_step(const Vector& side) {
  return {side[0] / kGrid, side[1] / kGrid, side[2] / kGrid};
}

Vector moved(Vector at, std::uint32_t count, const Vector& step) {
  for (std::size_t axis = 0; axis < 3; ++axis) mpz_addmul_ui(at[axis].backend().data(), step[axis].backend().data(), count);
  return at;
}

std::uint32_t other_corner(const Triangle& triangle, const Ends& edge) {
  return *std::ranges::find_if(triangle.vertices, [&](std::uint32_t v) { return v != edge[0] && v != edge[1]; });
}

}  // namespace

Integer exact_coordinate(float millimetres) {
  return std::fabs(millimetres) < std::ldexp(1.0F, -30) ? Integer(0) : integer_of(millimetres, kLengthScale);
}

Vector exact_point(const std::array<float, 3>& millimetres) {
  return {exact_coordinate(millimetres[0]), exact_coordinate(millimetres[1]), exact_coordinate(millimetres[2])};
}

Surface::Surface(const mesh::TriangleMesh& mesh) : fans_(mesh.vertices.size()) {
  for (const mesh::Vertex& vertex : mesh.vertices) vertices_.push_back(exact_point(vertex));
  std::map<Ends, std::vector<std::size_t>> triangles_at;
  for (const mesh::Triangle& v : mesh.triangles) {
    Triangle triangle{v, {}, {}, {}, {}, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = v[i], to = v[(i + 1) % 3];
      triangle.sides[i] = vertices_[to] - vertices_[from];
      triangles_at[sorted(from, to)].push_back(triangles_.size());
      fans_[from].triangles.push_back(triangles_.size());
    }
    triangle.steps = {grid_step(triangle.sides[0]), grid_step(-triangle.sides[2])};
    triangle.normal = cross(triangle.sides[0], -triangle.sides[2]);
    triangle.normal_squared = dot(triangle.normal, triangle.normal);
    for (std::size_t i = 0; i < 3; ++i) triangle.inward[i] = cross(triangle.normal, triangle.sides[i]);
    triangles_.push_back(std::move(triangle));
  }
  for (auto& [ends, triangles] : triangles_at) {
    Edge edge{ends, std::move(triangles), vertices_[ends[1]] - vertices_[ends[0]], {}, {}, Fold::flat};
    edge.step = grid_step(edge.along);
    edge.length_squared = dot(edge.along, edge.along);
    if (edge.triangles.size() == 2) {
      const std::uint32_t d = other_corner(triangles_[edge.triangles[1]], ends);
      edge.fold = fold_of(dot(triangles_[edge.triangles[0]].normal, vertices_[d] - vertices_[ends[0]]));
    }
    for (const std::uint32_t v : ends) {
      fans_[v].edges.push_back(edges_.size());
      fans_[v].is_rim |= edge.triangles.size() == 1;
    }
    for (const std::size_t i : edge.triangles)
      for (std::size_t side = 0; side < 3; ++side)
        if (sorted(triangles_[i].vertices[side], triangles_[i].vertices[(side + 1) % 3]) == ends)
          triangles_[i].edges[side] = edges_.size();
    edges_.push_back(std::move(edge));
  }
}

bool Surface::is_at_rim(const Feature& feature) const {
  if (feature.place == mesh::Place::vertex) return fans_[feature.index].is_rim;
  return feature.place == mesh::Place::edge && edges_[feature.index].triangles.size() == 1;
}

std::vector<std::size_t> Surface::triangles_at(const Feature& feature) const {
  if (feature.place == mesh::Place::vertex) return fans_[feature.index].triangles;
  if (feature.place == mesh::Place::edge) return edges_[feature.index].triangles;
  return {feature.index};
}

Vector Surface::position(const GridPoint& point) const {
  const auto [place, index] = point.feature;
  if (place == mesh::Place::vertex) return vertices_[index];
  if (place == mesh::Place::edge) return moved(vertices_[edges_[index].vertices[0]], point.parameter[0], edges_[index].step);
  const Triangle& triangle = triangles_[index];
  return moved(moved(vertices_[triangle.vertices[0]], point.parameter[0], triangle.steps[0]), point.parameter[1],
               triangle.steps[1]);
}

std::size_t Surface::edge_between(std::uint32_t a, std::uint32_t b) const {
  const auto found = std::ranges::lower_bound(edges_, sorted(a, b), {}, &Edge::vertices);
  return static_cast<std::size_t>(found - edges_.begin());
}

GridPoint Surface::on_edge(std::size_t edge, std::uint32_t m) const {
  if (m == 0) return {{mesh::Place::vertex, edges_[edge].vertices[0]}, {}};
  if (m == kGrid) return {{mesh::Place::vertex, edges_[edge].vertices[1]}, {}};
  return {{mesh::Place::edge, edge}, {m, 0}};
}

GridPoint Surface::on_edge_from(std::uint32_t a, std::uint32_t b, std::uint32_t m) const {
  return on_edge(edge_between(a, b), a < b ? m : kGrid - m);
}

GridPoint Surface::in_triangle(std::size_t triangle, std::uint32_t k, std::uint32_t l) const {
  const auto [a, b, c] = triangles_[triangle].vertices;
  if (l == 0) return on_edge_from(a, b, k);
  if (k == 0) return on_edge_from(a, c, l);
  if (k + l == kGrid) return on_edge_from(b, c, l);
  return {{mesh::Place::triangle, triangle}, {k, l}};
}

}  // namespace forceshade::reference::meshes
