// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Distances of points and edges, exactly.

#include <cmath>

#include "rendering/meshes/whole_vectors.h"

namespace forceshade::mesh {

// The square of a distance in units of 2^-106 mm².
using SquaredDistance = WholeFraction;

// mm
inline double root(const SquaredDistance& square) {
  return std::sqrt(static_cast<double>(square.over) / static_cast<double>(square.under)) * std::ldexp(1.0, -kCoordinateBits);
}

inline SquaredDistance squared(const WholeVector& v) {
  return {dot(v, v), 1};
}

inline SquaredDistance squared(float length) {
  const Whole whole = whole_coordinate<Whole>(length);
  return {whole * whole, 1};
}

// From p to the edge from a to b, ends included; a and b differ.
inline SquaredDistance squared_distance(const Vertex& p, const Vertex& a, const Vertex& b) {
  const WholeVector from_a = side(a, p), along = side(a, b);
  const Whole share = dot(from_a, along), length = dot(along, along);
  if (share <= 0) return squared(from_a);
  if (share >= length) return squared(side(b, p));
  const WholeVector across = cross(from_a, along);
  return {dot(across, across), length};
}

// From one edge to the other, ends included.
SquaredDistance squared_distance(const std::array<Vertex, 2>& s, const std::array<Vertex, 2>& t);

}  // namespace forceshade::mesh
