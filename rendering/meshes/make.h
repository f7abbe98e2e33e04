// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes of simple shapes, lengths in mm. They are computed in binary64, and each coordinate is rounded to binary32. Fronts are
// outside, or on top. Each function throws std::invalid_argument where a number is out of its range: a length is above 0 and no
// coordinate is beyond 10000 mm; a mesh has at most 2^28 triangles.

#include <cstdint>
#include <functional>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

// A geodesic sphere around the origin: each face of an icosahedron in frequency^2 triangles, 20 frequency^2 in all; frequency
// of 1 or more. All vertices lie on the sphere.
TriangleMesh icosphere(std::uint32_t frequency, double radius);

// A box with edges along the axes, around the origin: 12 triangles.
TriangleMesh box(double size_x, double size_y, double size_z);
TriangleMesh cube(double size);

// A rectangle in the plane z = 0, around the origin, that has a rim and no thickness: columns x rows cells, each of two
// triangles.
TriangleMesh thin_wall(double size_x, double size_y, std::uint32_t columns, std::uint32_t rows);

// Around the z axis: `around` sections at equal angles, each of `across` corners; 3 or more each, across_radius < radius.
TriangleMesh torus(double radius, double across_radius, std::uint32_t around, std::uint32_t across);

// z = height(x, y) over a rectangle around the origin, in columns x rows cells of two triangles, cut along the diagonal from
// low x, y to high x, y.
TriangleMesh height_map(double size_x, double size_y, std::uint32_t columns, std::uint32_t rows,
                        const std::function<double(double x, double y)>& height);

// The thesis's bump, a cap of width w of a sphere of this radius on a plane (width <= 2 radius), over a square of this size
// with cells x cells cells.
TriangleMesh bump(double radius, double width, double size, std::uint32_t cells);
// The same of a cylinder along y.
TriangleMesh cylinder_bump(double radius, double width, double size, std::uint32_t cells);

// Points of a texture, in mm, for each corner of each triangle. Seen from above: x and y of the vertex, one chart. From a box:
// those two coordinates of it that are across the axis along which the triangle's normal is longest, as they are seen from
// outside; so there are up to six charts, with seams between them.
std::vector<std::array<TexturePoint, 3>> texture_from_above(const TriangleMesh& mesh);
std::vector<std::array<TexturePoint, 3>> texture_from_box(const TriangleMesh& mesh);

}  // namespace forceshade::mesh
