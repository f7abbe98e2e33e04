// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh in exact numbers: what each vertex, edge and triangle has around it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "reference/meshes/integers.h"

namespace forceshade::reference::meshes {

// Lengths are integers in units of 2^-77 mm: coordinates are multiples of 2^-53 mm, and a point of the grid of an edge or of a
// triangle is a vertex plus multiples of 2^-24 of its sides.
inline constexpr int kLengthScale = 77;
inline constexpr std::uint32_t kGrid = std::uint32_t{1} << 24;

// A coordinate in these units; below 2^-30 mm in size it is read as 0.
Integer exact_coordinate(float millimetres);
Vector exact_point(const std::array<float, 3>& millimetres);

// A vertex, an edge or a triangle: its open interior, so that every point of the surface is in one feature and no other.
struct Feature {
  mesh::Place place;
  std::size_t index;  // in the list of its kind in Surface
  bool operator==(const Feature&) const = default;
};

// A point of the grid of a feature, with the parameters of mesh::GodObject.
struct GridPoint {
  Feature feature;
  std::array<std::uint32_t, 2> parameter{};
};

struct Triangle {
  mesh::Triangle vertices;
  std::array<std::size_t, 3> edges;  // 0: from corner 0 to 1; 1: from 1 to 2; 2: from 2 to 0
  std::array<Vector, 3> sides;       // along the edges, in this sense
  std::array<Vector, 2> steps;       // 2^-24 of the sides from corner 0: to 1 and to 2
  Vector normal;                     // (b - a) x (c - a)
  Integer normal_squared;
  std::array<Vector, 3> inward;  // in the plane, at a right angle to each side, into the triangle: normal x side
};

// The fold of an edge as it is seen from in front; a rim's edge is flat.
enum class Fold { narrow, flat, wide };

struct Edge {
  std::array<std::uint32_t, 2> vertices;  // the lower index first
  std::vector<std::size_t> triangles;     // one or two, in order
  Vector along;                           // from the first vertex to the second
  Vector step;                            // 2^-24 of it
  Integer length_squared;
  Fold fold;
};

struct Fan {
  std::vector<std::size_t> edges;      // in order
  std::vector<std::size_t> triangles;  // in order
  bool is_rim = false;
};

class Surface {
 public:
  // The mesh has been checked.
  explicit Surface(const mesh::TriangleMesh& mesh);

  const std::vector<Vector>& vertices() const { return vertices_; }
  const std::vector<Edge>& edges() const { return edges_; }  // sorted by their vertices
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Fan& fan(std::size_t vertex) const { return fans_[vertex]; }

  bool is_at_rim(const Feature& feature) const;
  std::vector<std::size_t> triangles_at(const Feature& feature) const;  // in order
  Vector position(const GridPoint& point) const;

  // The number of the edge with these vertices, which must be those of one.
  std::size_t edge_between(std::uint32_t a, std::uint32_t b) const;

  // The point a + (k/2^24) (b - a) + (l/2^24) (c - a) of a closed triangle, or a + (m/2^24) (b - a) of a closed edge, in the
  // feature that it is in.
  GridPoint in_triangle(std::size_t triangle, std::uint32_t k, std::uint32_t l) const;
  GridPoint on_edge(std::size_t edge, std::uint32_t m) const;

 private:
  GridPoint on_edge_from(std::uint32_t a, std::uint32_t b, std::uint32_t m) const;

  std::vector<Vector> vertices_;
  std::vector<Edge> edges_;
  std::vector<Triangle> triangles_;
  std::vector<Fan> fans_;
};

}  // namespace forceshade::reference::meshes
