// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Schemes that give a direction at each corner of each triangle and interpolate: where these directions are shared, and how one
// goes over into another on an edge where they are not (docs/god-object.md).

#include "reference/meshes/schemes/scheme.h"

namespace forceshade::reference::meshes {

class SharedCorners : public Scheme {
 public:
  explicit SharedCorners(const Surface& surface) : surface_(surface) {}

  Direction direction(const Rest& rest) const final;

 protected:
  // True if two triangles at a vertex have the same corner there.
  virtual bool are_same(std::size_t first, std::size_t second, std::size_t vertex) const = 0;
  // N, times the sum of the weights and a constant of the scheme, of a triangle at the point with these weights of its corners.
  virtual Vector interpolated(std::size_t triangle, const std::array<Integer, 3>& weights) const = 0;

  std::size_t corner(std::size_t triangle, std::size_t vertex) const;

 private:
  Vector along_edge(const Edge& edge, std::size_t triangle, const Fraction& t) const;
  Direction on_edge(const Edge& edge, const Rest& rest) const;
  Direction at_vertex(std::size_t vertex) const;
  Integer length(std::size_t triangle) const;

  const Surface& surface_;
};

}  // namespace forceshade::reference::meshes
