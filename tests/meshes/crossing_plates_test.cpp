// SPDX-License-Identifier: BSD-3-Clause
// The god-object where a floor and a wall cross: along their line, from behind, and up a ramp.

#include "tests/meshes/allowed_crossings.h"
#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using tests::BothSides;
using tests::crossing;
using tests::kStiffness;

// Two plates that cross at a right angle, each blocking from its front alone: a floor and a wall.
TriangleMesh floor_and_wall(float slope, float offset = 0.1F) {
  TriangleMesh mesh;
  mesh.vertices = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  // Its front towards +x; with a slope it leans back, as a ramp does.
  for (const auto& [y, z] : {std::array{-19.0F, -7.0F}, {19.0F, -7.0F}, {19.0F, 9.0F}, {-19.0F, 9.0F}})
    mesh.vertices.push_back({offset - slope * z, y, z});
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  return mesh;
}

TEST(crossing_sheets, a_god_object_goes_along_the_line_where_a_floor_and_a_wall_cross) {
  BothSides both(crossing(floor_and_wall(0)));
  both.step({5, -11.3F, 3});
  both.step({5, -11.3F, -1});
  std::size_t most = 0;
  for (int i = 0; i <= 200; ++i) {
    const std::array<float, 3> p{-1.5F, -11.3F + 0.11F * static_cast<float>(i), -1.0F};
    const mesh::Tick tick = both.step(p), again = both.step(p);
    most = std::max<std::size_t>(most, tick.moves);
    // r = (0.1, p_y, 0), but for some steps of the grid, of 40 mm/2^24 each.
    EXPECT_NEAR(tick.force[0], kStiffness * 1.6, 1e-4) << i;
    EXPECT_NEAR(tick.force[1], 0, 1e-4) << i;
    EXPECT_NEAR(tick.force[2], kStiffness * 1, 1e-4) << i;
    EXPECT_EQ(again.after, tick.after);
    EXPECT_EQ(again.force, tick.force);
  }
  std::printf("  at most %zu moves in a tick\n", most);
}

// A wall that runs nearly as the floor's grid does. Beside it some point of the grid is always a little nearer to the wall and
// to p; a god-object that took each of them in turn would need hundreds of moves.
TEST(crossing_sheets, a_god_object_does_not_creep_along_a_wall_from_point_to_point_of_the_grid) {
  for (const float slope : {1 / 50.0F, 1 / 300.0F, -1 / 300.0F, 1 / 2000.0F}) {
    TriangleMesh plates;
    plates.vertices = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
    for (const auto& [x, z] : {std::array{-19.0F, -7.0F}, {-19.0F, 9.0F}, {19.0F, 9.0F}, {19.0F, -7.0F}})
      plates.vertices.push_back({x, 0.1F + slope * x, z});  // its front towards +y
    plates.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    std::size_t most = 0, sum = 0;
    for (int i = 0; i < 40; ++i) {
      BothSides both(crossing(plates));
      const float x = 1.37F + 0.113F * static_cast<float>(i);
      for (const std::array<float, 3>& p : {std::array{x, 5.0F, 3.0F}, {x, 5.0F, -1.0F}, {x + 0.7F, -2.3F, -1.0F}}) {
        const std::size_t moves = both.step(p).moves;
        most = std::max(most, moves);
        sum += moves;
      }
    }
    std::printf("  slope %.5f: at most %zu moves in a tick, %zu in 120\n", static_cast<double>(slope), most, sum);
    EXPECT_LE(most, 8U) << slope;
  }
}

// The only way to a state that lies in two features: the origin, a point of the grid of both plates, to which the start is
// rounded.
TEST(crossing_sheets, a_path_may_begin_where_sheets_cross) {
  const TriangleMesh plates = floor_and_wall(0, 0);
  for (const Sides sides : {Sides::front, Sides::both})
    for (const float x : {-1e-7F, 0.0F, 1e-7F, -1.0F, 1.0F})
      for (const float z : {-1e-7F, 0.0F, 1e-7F, -1.0F, 1.0F}) {
        BothSides both(crossing(plates, sides));
        for (const std::array<float, 3>& p : {std::array{0.0F, 2e-9F, 3e-9F}, {x, -6e-9F, z}, {-x, 7e-9F, -z}}) both.step(p);
      }
}

// Its way meets the edge between the wall's two triangles.
TEST(crossing_sheets, a_slide_from_behind_a_wall_goes_through_an_edge_of_it) {
  TriangleMesh plates = floor_and_wall(0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < 2; ++axis) plates.vertices[i][axis] *= 0.8F;  // to 16
  constexpr float kDiagonal = -2.375F;  // y where the wall's diagonal meets the floor
  BothSides both(crossing(plates));
  for (const auto& [x, z] : {std::pair{-4.0F, 1.0F}, {-4.0F, -1.0F}, {6.0F, -1.0F}}) both.step({x, kDiagonal, z});
  EXPECT_EQ(tests::point_of(plates, both.state()), tests::exact({6, kDiagonal, 0}));
}

TEST(crossing_sheets, a_god_object_climbs_a_ramp_that_goes_through_the_floor) {
  BothSides both(crossing(floor_and_wall(1)));  // its front towards (1, 0, 1)
  both.step({5, 1, 3});
  both.step({5, 1, -0.1F});
  const mesh::Tick tick = both.step({-5, 1, -0.1F});
  // The foot on x + z = 0.1 is (5.2/2) (1, 0, 1) off p.
  EXPECT_EQ(tick.status, Status::contact);
  EXPECT_GE(tick.after.index[0], 2U) << "on the ramp";
  EXPECT_NEAR(tick.force[0], kStiffness * 2.6, 1e-4);
  EXPECT_NEAR(tick.force[1], 0, 1e-4);
  EXPECT_NEAR(tick.force[2], kStiffness * 2.6, 1e-4);
}

}  // namespace
}  // namespace forceshade
