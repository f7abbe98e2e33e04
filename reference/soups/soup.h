// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Any finite set of triangles, in exact numbers.

#include <cstdint>
#include <utility>
#include <vector>

#include "forceshade/mesh.h"
#include "reference/soups/numbers.h"

namespace forceshade::reference::soups {

// As a position is read: below 2^-30 mm in size a coordinate is 0.
std::array<float, 3> quantised(const std::array<float, 3>& millimetres);
Vector exact_point(const std::array<float, 3>& millimetres);

struct Triangle {
  std::size_t number;                 // in the file
  std::array<std::uint32_t, 3> name;  // of its vertices: the lowest index with these coordinates that a triangle uses
  std::array<Vector, 3> corner;
  Vector normal;              // (b - a) x (c - a), not 0
  bool blocks_along = false;  // it blocks motion against its normal, and with this along it, too
  float static_friction = 0, dynamic_friction = 0;

  Vector side(std::size_t i) const { return corner[(i + 1) % 3] - corner[i]; }  // from corner i to the next
  // The distance of x, a point of the plane, from side i, times a positive number; negative outside.
  Rational inside(std::size_t i, const Vector& x) const { return dot(cross(side(i), x - corner[i]), normal); }
  bool has_in_plane(const Vector& x) const { return dot(normal, x - corner[0]).is_zero(); }
  // True if it blocks motion from where `up` points.
  bool blocks_from(const Vector& up) const { return blocks_along || dot(normal, up) > 0; }
  bool holds(const Vector& x) const;  // closed
  bool holds_strictly(const Vector& x) const;
  // The weights of corners b and c at x in its plane.
  std::array<Rational, 2> weights(const Vector& x) const;
  Vector at(const Rational& beta, const Rational& gamma) const { return corner[0] + beta * side(0) - gamma * side(2); }
};

// Ends of binary64, between which coordinates lie.
struct Box {
  std::array<double, 3> low, high;
};

class Soup {
 public:
  // Triangles without area are left out. sides: one for all, or one for each triangle. materials: one for each triangle, or
  // none.
  Soup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides,
       const std::vector<mesh::Material>& materials = {});

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Triangle& numbered(std::size_t number) const;           // as in the file; it has an area
  std::vector<const Triangle*> holding(const Vector& x) const;  // in order
  const Vector& vertex(std::uint32_t name) const { return vertices_[name]; }

  // The number of triangles whose boxes, along the axes, have a point in common with the straight way from a to b.
  std::size_t looks(const Vector& a, const Vector& b) const;

  // The numbers t > 0, up to `most`, at which the set of triangles that hold from + t along changes; in order, each once.
  std::vector<Rational> changes(const Vector& from, const Vector& along, const Rational& most) const;

 private:
  std::vector<Vector> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;  // of the triangles
};

}  // namespace forceshade::reference::soups
