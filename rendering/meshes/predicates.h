// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// On which side a point is, exactly, and which triangles have points in common. Vertices are of a mesh that was read: each
// coordinate is 0 or of 2^-30 to 10000 mm in size.

#include <array>
#include <cstdint>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

using TrianglePoints = std::array<Vertex, 3>;

// The sign of ((b - a) x (c - a)) . (d - a): 1 where d is in front of triangle (a, b, c), -1 where it is behind, 0 in its
// plane.
int side_of(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d);

// The sign of component `axis` of (b - a) x (c - a).
int turn(std::size_t axis, const Vertex& a, const Vertex& b, const Vertex& c);

// True if its normal is not 0.
bool has_area(const TrianglePoints& triangle);

// True if two triangles with an area, borders included, have any point in common ...
bool meet(const TrianglePoints& s, const TrianglePoints& t);
// ... any other than the first corner, which is the same point ...
bool meet_beside_corner(const TrianglePoints& s, const TrianglePoints& t);
// ... any other than the edge of the first two corners, which are the same points.
bool meet_beside_edge(const TrianglePoints& s, const TrianglePoints& t);

// The numbers of signs that the calling thread's predicates had decided in binary64, in integers of 128 bits, and in integers
// of 256 bits.
struct Stages {
  std::uint64_t binary64 = 0, bits_128 = 0, bits_256 = 0;
};
Stages stages();

}  // namespace forceshade::mesh
