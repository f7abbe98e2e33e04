// SPDX-License-Identifier: BSD-3-Clause
// Ticks that take many operations, at vertices with many triangles.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using tests::BothSides;

constexpr float kStiffness = 0.3F;  // N/mm

MeshRendering rendering_of(const TriangleMesh& mesh, Sides sides) {
  return {tests::checked(mesh), {}, sides, mesh::Shading::none, kStiffness, {}};
}

// n triangles around the origin, which is a vertex; their other corners lie 50 mm off it, at heights up to 5 mm.
TriangleMesh fan(std::uint32_t n) {
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    mesh.vertices.push_back({static_cast<float>(50 * std::cos(angle)), static_cast<float>(50 * std::sin(angle)),
                             static_cast<float>(0.05 * (7919 * i % 100))});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

// Each triangle at a vertex meets a flight through it, and to find how the vertex lies to it looks at each of them.
TEST(hard_ticks, a_tick_at_a_vertex_of_many_triangles_looks_at_each_of_them_but_a_few_times) {
  constexpr std::uint32_t kTriangles = 200;
  std::size_t most = 0, ticks = 0;
  for (const Sides sides : {Sides::front, Sides::both})
    for (const float from : {3.0F, -3.0F})
      for (const std::array<float, 3>& to : {std::array{0.0F, 0.0F, -from}, {0.0F, 0.0F, 0.0F}, {0.1F, -0.2F, -from}}) {
        BothSides both(rendering_of(fan(kTriangles), sides));
        for (const std::array<float, 3>& p : {std::array{-to[0], -to[1], from}, to, std::array{0.3F, 0.1F, -from}}) {
          both.step(p);
          most = std::max(most, both.decisions()[0] + both.decisions()[1]);
          ++ticks;
        }
      }
  std::printf("  %zu ticks, at most %zu decisions for %u triangles\n", ticks, most, kTriangles);
  EXPECT_LE(most, 12 * kTriangles);
}

}  // namespace
}  // namespace forceshade
