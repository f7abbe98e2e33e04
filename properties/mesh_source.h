// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random meshes that are hard for a god-object.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "forceshade/mesh.h"
#include "properties/positions.h"

namespace forceshade::properties {

inline constexpr std::array<std::string_view, 11> kMeshFamilies{
    "height field",  // an open sheet: level, tilted, rough, nearly level, of numbers of all binades
    "slivers",       // the same with triangles that are nearly without height
    "needles",       // the same with cells up to 2^15 times as long as they are wide
    "fan",           // one vertex with 3 to 200 triangles: a pyramid, a saddle, rough
    "bipyramid",     // two such fans, closed
    "slab",          // closed, with walls at a right angle to a level or rough top and bottom
    "double wall",   // two sheets, down to one unit in the last place apart
    "star",          // closed, smooth to spiky
    "torus",         // closed
    "folds",         // a sheet that is folded to and fro, nearly onto itself
    "stairs"         // horizontal and vertical faces
};

struct RandomMesh {
  std::size_t family;  // in kMeshFamilies
  mesh::TriangleMesh mesh;
  mesh::Sides sides;
};

// An endless, repeatable stream of meshes, each family in turn. Every one is what docs/god-object.md demands, because of how it
// is built. Axes change places, the size is multiplied by a power of two, some lie far from the origin; vertices and triangles
// come in any order.
class MeshSource : private Draws {
 public:
  explicit MeshSource(std::uint64_t seed) : Draws(seed) {}

  RandomMesh next() { return of_family(count_++ % kMeshFamilies.size()); }
  RandomMesh of_family(std::size_t family);

  // One normal for each vertex, or one for each of some of its triangles; unit vectors about those of the surface, but for
  // some that point elsewhere.
  mesh::CornerNormals normals_of(const mesh::TriangleMesh& mesh);
  // A map laid along two directions, some 20 mm of it over the mesh; some corners have a point or a gradient of their own, so
  // that there are seams.
  mesh::CornerTextures textures_of(const mesh::TriangleMesh& mesh);
  // One material for all triangles, or some by face: smooth, from 2^-10 to 2^10, and infinite; without a stiffness.
  mesh::Materials materials_of(const mesh::TriangleMesh& mesh);

 private:
  using Point = std::array<double, 3>;
  // Triangles in a plane, counter-clockwise; its border as a loop, counter-clockwise.
  struct Planar {
    std::vector<std::array<double, 2>> points;
    std::vector<mesh::Triangle> triangles;
    std::vector<std::uint32_t> border;
  };
  struct Solid {
    std::vector<Point> vertices;
    std::vector<mesh::Triangle> triangles;
    bool is_closed = false;
  };

  int whole(int low, int high);  // both included
  mesh::Material material();
  double on_lattice(double value) const;

  Planar grid(double width_of_cell, double depth_of_cell, bool has_slivers);
  Planar fan();
  std::vector<double> heights(const Planar& planar);
  Solid sheet(const Planar& planar);
  Solid bipyramid();
  Solid slab(const Planar& planar);
  Solid double_wall();
  Solid star();
  Solid torus();
  Solid extruded(const std::vector<std::array<double, 2>>& profile);
  Solid folds();
  Solid stairs();
  void add_cells(Solid& solid, int rows, int columns, bool is_cyclic);
  mesh::TriangleMesh placed(Solid solid);

  std::size_t count_ = 0;
};

}  // namespace forceshade::properties
