// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object's place by the mesh's own numbering: include/forceshade/mesh.h states it by the file's.

#include <algorithm>

#include "fast/damping/limits.h"
#include "fast/meshes/decide.h"
#include "forceshade/mesh.h"

namespace forceshade::fast {

struct GridPoint {
  mesh::Place place = mesh::Place::nowhere;
  mesh::Side side = mesh::Side::front;
  HalfEdge half = 0;                      // vertex: one from it; edge: one of its halves; triangle: 3·face
  std::array<std::uint32_t, 2> weight{};  // edge: {that of the half's end}; triangle: {k, l}
  std::array<float, 3> position{};        // free: mm, as quantised
};

inline GridPoint grid_point_at_vertex(const Mesh& mesh, HalfEdge from, mesh::Side side) noexcept {
  return {mesh::Place::vertex, mesh.is_at_rim(mesh.start(from)) ? mesh::Side::front : side, from, {}, {}};
}
// weight: of the half's end, 0 and 2^24 included.
inline GridPoint grid_point_on_edge(const Mesh& mesh, HalfEdge h, std::uint32_t weight, mesh::Side side) noexcept {
  if (weight == 0) return grid_point_at_vertex(mesh, h, side);
  if (weight == kGrid) return grid_point_at_vertex(mesh, next(h), side);
  return {mesh::Place::edge, mesh.twin(h) == kRim ? mesh::Side::front : side, h, {weight, 0}, {}};
}
// k, l: of the second and the third corner, on the border or inside.
inline GridPoint grid_point_in_triangle(const Mesh& mesh, std::uint32_t face, std::uint32_t k, std::uint32_t l,
                                        mesh::Side side) noexcept {
  if (l == 0) return grid_point_on_edge(mesh, 3 * face, k, side);
  if (k == 0) return grid_point_on_edge(mesh, 3 * face + 2, kGrid - l, side);
  if (k + l == kGrid) return grid_point_on_edge(mesh, 3 * face + 1, l, side);
  return {mesh::Place::triangle, side, 3 * face, {k, l}, {}};
}

inline bool is_touching(const GridPoint& grid_point) noexcept {
  return grid_point.place != mesh::Place::nowhere && grid_point.place != mesh::Place::free;
}

// The weights of the corners of `face`, which the grid point belongs to.
inline std::array<std::uint32_t, 3> weights_in(const Mesh& mesh, const GridPoint& grid_point, std::uint32_t face) noexcept {
  std::array<std::uint32_t, 3> weights{};
  if (grid_point.place == mesh::Place::triangle)
    return {kGrid - grid_point.weight[0] - grid_point.weight[1], grid_point.weight[0], grid_point.weight[1]};
  if (grid_point.place == mesh::Place::edge) {
    const bool is_first = face_of(grid_point.half) == face;
    const HalfEdge h = is_first ? grid_point.half : mesh.twin(grid_point.half);
    weights[corner_of(h)] = is_first ? kGrid - grid_point.weight[0] : grid_point.weight[0];
    weights[after(corner_of(h))] = is_first ? grid_point.weight[0] : kGrid - grid_point.weight[0];
    return weights;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh.face(face).vertex[i] == mesh.start(grid_point.half)) weights[i] = kGrid;
  return weights;
}

inline Point point_of(const Mesh& mesh, const GridPoint& grid_point) noexcept {
  const Face& f = mesh.face(face_of(grid_point.half));
  const std::uint32_t i = corner_of(grid_point.half);
  switch (grid_point.place) {
    case mesh::Place::vertex: return Point::at(f.corner[i].data());
    case mesh::Place::edge:
      return {
          {f.corner[i].data(), f.corner[after(i)].data(), nullptr}, {kGrid - grid_point.weight[0], grid_point.weight[0], 0}, 2};
    case mesh::Place::triangle:
      return {{f.corner[0].data(), f.corner[1].data(), f.corner[2].data()},
              {kGrid - grid_point.weight[0] - grid_point.weight[1], grid_point.weight[0], grid_point.weight[1]},
              3};
    default: return Point::at(grid_point.position.data());
  }
}

// Calls include(f) for each triangle of its feature, once or more; it touches the mesh.
template <class Include>
void for_each_triangle_at(const Mesh& mesh, const GridPoint& grid_point, const Include& include) noexcept {
  include(face_of(grid_point.half));
  if (grid_point.place == mesh::Place::edge && mesh.twin(grid_point.half) != kRim) include(face_of(mesh.twin(grid_point.half)));
  if (grid_point.place != mesh::Place::vertex) return;
  const HalfEdge start = mesh.first_around(mesh.start(grid_point.half));
  for (HalfEdge h = mesh.around(start); h != kRim && h != start; h = mesh.around(h)) include(face_of(h));
  include(face_of(start));
}

// N/mm, where materials have one; usual: of those that have none. That of an edge or a vertex is the largest of its triangles.
inline float stiffness_at(const Mesh& mesh, const GridPoint& grid_point, float usual) noexcept {
  float largest = 0;
  for_each_triangle_at(mesh, grid_point,
                       [&](std::uint32_t f) { largest = std::max(largest, mesh.stiffness_in_triangle(f).value_or(usual)); });
  return largest;
}

// Limits, where materials have some: of an edge or a vertex each the largest of its triangles.
inline damping::Limits damping_at(const Mesh& mesh, const GridPoint& grid_point) noexcept {
  damping::Limits largest{0, 0};
  for_each_triangle_at(mesh, grid_point,
                       [&](std::uint32_t f) { largest = larger_limits(largest, mesh.damping_in_triangle(f)); });
  return largest;
}

// True if the triangle holds the grid point.
inline bool touches(const Mesh& mesh, const GridPoint& grid_point, std::uint32_t face) noexcept {
  switch (grid_point.place) {
    case mesh::Place::vertex: {
      const auto& corners = mesh.face(face).vertex;
      const std::uint32_t v = mesh.start(grid_point.half);
      return corners[0] == v || corners[1] == v || corners[2] == v;
    }
    case mesh::Place::edge:
      return face == face_of(grid_point.half) ||
             (mesh.twin(grid_point.half) != kRim && face == face_of(mesh.twin(grid_point.half)));
    case mesh::Place::triangle: return face == face_of(grid_point.half);
    default: return false;
  }
}

// Between the mesh's numbering and the file's. An object that the mesh does not have is nowhere.
GridPoint grid_point_of(const Mesh& mesh, const mesh::GodObject& object) noexcept;
mesh::GodObject object_of(const Mesh& mesh, const GridPoint& grid_point) noexcept;

}  // namespace forceshade::fast
