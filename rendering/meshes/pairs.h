// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two triangles of a mesh.

#include <algorithm>
#include <cstdint>
#include <utility>

#include "rendering/meshes/predicates.h"
#include "rendering/meshes/readers.h"

namespace forceshade::mesh {

// The most pairs of triangles with boxes that meet which are looked at: half a minute's work or so.
inline std::uint64_t most_pairs(std::size_t triangles) {
  return (std::uint64_t{1} << 30) + 64 * std::uint64_t{triangles};
}

// Coordinates as they are rendered; those that are no coordinates stay.
inline void quantise(TriangleMesh& mesh) {
  for (Vertex& vertex : mesh.vertices)
    for (float& x : vertex) x = coordinate(x).value_or(x);
}

// Puts the corners that two triangles share first, in the same order. Returns their number.
inline std::size_t shared_first(Triangle& s, Triangle& t) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = shared; k < 3; ++k)
      if (s[i] == t[k]) {
        std::swap(s[i], s[shared]);
        std::swap(t[k], t[shared]);
        ++shared;
        break;
      }
  return shared;
}

inline bool are_in_one_plane(const TrianglePoints& s, const TrianglePoints& t) {
  return std::ranges::all_of(t, [&](const Vertex& point) { return side_of(s[0], s[1], s[2], point) == 0; });
}

}  // namespace forceshade::mesh
