// SPDX-License-Identifier: BSD-3-Clause
// Rests half-way between two points of the grid, on a point of it, and one position's quantum beside these: cases that a random
// path meets once in some hundred thousand ticks.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "forceshade/reference.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"

namespace forceshade::fast {
namespace {

constexpr int kQuanta = 64;  // positions' quanta (2^-30 mm) in a step of the grid along a side of 1 mm
// Lengths of sides, mm. Over 3 and 7 binary64 rounds the quotients that it is to round.
constexpr int kSides[]{1, 3, 7};

// The state after one stroke through the surface, from (x, y, 1) to (x, y, -1); the same on both sides, filtered and not.
mesh::GodObject rest_below(const mesh::TriangleMesh& triangles, float x, float y) {
  const MeshRendering rendering = tests::unshaded(triangles, mesh::Sides::both);
  const Mesh mesh = tests::fast_mesh(rendering);
  const auto exact = tests::built(reference::GodObject::build(rendering));
  mesh::GodObject state;
  for (const float z : {1.0F, -1.0F}) {
    const std::array<float, 3> position{x, y, z};
    const mesh::Tick expected = exact.step(state, position);
    const mesh::Tick filtered = step(mesh, state, position, 1, mesh::Shading::none, FilteredStages());
    const mesh::Tick in_integers = step(mesh, state, position, 1, mesh::Shading::none, ExactStages());
    EXPECT_EQ(filtered.after, expected.after) << x << ", " << y << ", " << z;
    EXPECT_EQ(in_integers.after, expected.after) << x << ", " << y << ", " << z;
    EXPECT_EQ(filtered.force, expected.force);
    EXPECT_EQ(in_integers.force, expected.force);
    state = expected.after;
  }
  return state;
}

float position_of(int quanta) {
  return std::ldexp(static_cast<float>(quanta), -30);
}

std::uint32_t nearest_to_even(int quanta) {
  const int floor = quanta / kQuanta, rest = quanta % kQuanta;
  return static_cast<std::uint32_t>(floor + (2 * rest > kQuanta || (2 * rest == kQuanta && floor % 2 == 1) ? 1 : 0));
}

// Steps of the grid, even and odd, up to where positions no longer resolve 1/64 of one.
constexpr int kSteps[]{1, 2, 3, 1000, 1001, 30000, 30001};
// Quanta beside a point of the grid and beside the middle between two.
constexpr int kBeside[]{0, 1, kQuanta / 2 - 1, kQuanta / 2, kQuanta / 2 + 1, kQuanta - 1};

TEST(grid_ties, in_a_triangle_go_to_the_even_step) {
  int cases = 0;
  for (const int side : kSides) {
    const auto length = static_cast<float>(side);
    const mesh::TriangleMesh triangle{{{0, 0, 0}, {length, 0, 0}, {0, length, 0}}, {{0, 1, 2}}};
    for (const int step_x : kSteps)
      for (const int beside_x : kBeside)
        for (const int beside_y : kBeside) {
          const int x = kQuanta * step_x + beside_x, y = kQuanta * 77 + beside_y;
          const auto state = rest_below(triangle, position_of(side * x), position_of(side * y));
          ASSERT_EQ(state.place, mesh::Place::triangle);
          EXPECT_EQ(state.parameter, (std::array{nearest_to_even(x), nearest_to_even(y)}))
              << x << ", " << y << " quanta of " << side;
          ++cases;
        }
  }
  std::printf("  %d rests\n", cases);
}

// A valley whose bottom runs along x, from vertex 0 or 1 at 0 to the other one at `length` mm.
mesh::TriangleMesh valley(float length, bool lower_vertex_first) {
  mesh::TriangleMesh mesh{{{0, 0, 0}, {length, 0, 0}, {length / 2, 1, 1}, {length / 2, -1, 1}}, {{0, 1, 2}, {1, 0, 3}}};
  if (!lower_vertex_first) {
    std::swap(mesh.vertices[0], mesh.vertices[1]);
    mesh.triangles = {{1, 0, 2}, {0, 1, 3}};
  }
  return mesh;
}

TEST(grid_ties, on_an_edge_go_to_the_even_step) {
  constexpr std::uint32_t kGrid = 1U << 24;
  for (const int side : kSides)
    for (const bool lower_first : {true, false}) {
      const mesh::TriangleMesh mesh = valley(static_cast<float>(side), lower_first);
      for (const int step_x : kSteps)
        for (const int beside : kBeside) {
          const int x = kQuanta * step_x + beside;
          const auto state = rest_below(mesh, position_of(side * x), 0);
          ASSERT_EQ(state.place, mesh::Place::edge);
          // The parameter counts from vertex 0.
          const std::uint32_t from_left = nearest_to_even(x);
          EXPECT_EQ(state.parameter[0], lower_first ? from_left : kGrid - from_left) << x << " quanta of " << side;
        }
    }
}

// At the far ends of the sides, where the three weights must add up to the grid.
TEST(grid_ties, beside_the_longest_side_stay_in_the_triangle) {
  const mesh::TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  constexpr std::uint32_t kGrid = 1U << 24;
  for (const int step_y : {1, 2, 500})
    for (const int beside : kBeside) {
      const float y = position_of(kQuanta * step_y + beside);
      // Above 1/2 a position resolves steps of the grid; half a step left of the side and less is the side's own.
      const float x = 1 - std::ldexp(std::ceil(std::ldexp(y, 24)) + 1, -24);
      const auto state = rest_below(triangle, x, y);
      EXPECT_LE(state.parameter[0] + state.parameter[1], kGrid);
    }
}

}  // namespace
}  // namespace forceshade::fast
