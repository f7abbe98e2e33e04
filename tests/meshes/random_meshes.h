// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes that are embedded by the way they are made, and paths that aim at what is hard to decide on them.

#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "forceshade/vocabulary/mesh.h"

namespace forceshade::tests {

struct RandomMesh {
  std::string name;
  mesh::TriangleMesh mesh;
  mesh::CornerNormals normals;  // about unit vectors; shared around a vertex, but for some creases
  mesh::Sides sides;
};

inline constexpr std::size_t kMeshFamilies = 9;

// Of family seed % kMeshFamilies: sheets that are the graph of a function, lattice or any heights, strips, thin double walls,
// closed surfaces that are seen whole from their middle, with blunt and spiky corners of 3 to 200 triangles; some squeezed to
// needles.
RandomMesh random_mesh(std::uint32_t seed);

// The next position from the one before: steps of 10^-9 to 10^3 mm, axis-parallel moves to a vertex's coordinate, places on
// vertices, edges and triangles or just beside them, repeats, jumps, and now and then what is no position.
class RandomPath {
 public:
  RandomPath(const RandomMesh& mesh, std::uint32_t seed);

  std::array<float, 3> next();

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }
  std::array<float, 3> on_surface();

  const RandomMesh& mesh_;
  std::mt19937_64 random_;
  std::array<float, 3> position_{}, direction_{};
  int stroke_ = 0;  // steps that are left of it
};

}  // namespace forceshade::tests
