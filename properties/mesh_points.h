// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points and directions of binary64 numbers, as random meshes and paths are made of. Included by source files alone.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "forceshade/mesh.h"
#include "rendering/vectors.h"

namespace forceshade::properties {

using Point = std::array<double, 3>;

using mesh::cross, mesh::difference, mesh::dot;
inline double length(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline Point scaled_to(const Point& a, double its_length) {
  const double factor = its_length / std::max(length(a), std::numeric_limits<double>::min());
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

inline Point wide(const mesh::Vertex& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// mm: how far the triangles reach from the first corner.
inline double size_of(const mesh::TriangleMesh& mesh) {
  const Point from = wide(mesh.vertices[mesh.triangles[0][0]]);
  double size = 0;
  for (const mesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) size = std::max(size, length(difference(wide(mesh.vertices[v]), from)));
  return size;
}

}  // namespace forceshade::properties
