// SPDX-License-Identifier: BSD-3-Clause
// Rules of docs/soups.md that few drawn sets need, each on a small set: ties, cells after flights, and rests. Both sides go
// every path alike.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/meshes/soup_both_sides.h"

namespace forceshade {
namespace {

using tests::last_place;
using tests::last_tick;
using tests::Position;

// Two valleys lead down from a vertex, with a ridge between them: of their edges, which lead to the hand alike, the one with
// the lower names counts, and not the one whose wall comes first.
TEST(soup_rules, of_two_edges_alike_the_lower_names_count) {
  const std::vector<mesh::Vertex> vertices{{0, 0, 0}, {4, -4, -4}, {4, 4, -4}, {4, 0, 0}, {0, -8, 8}, {0, 8, 8}};
  const mesh::Triangle left{0, 1, 3}, right{0, 3, 2}, left_wall{0, 4, 1}, right_wall{0, 2, 5}, back{0, 5, 4};
  const std::vector<Position> path{{0, 0, 0}, {2, 0, -5}};
  EXPECT_EQ(last_place({vertices, {left, right, left_wall, right_wall, back}}, path).substr(0, 5), "e 0 1");
  EXPECT_EQ(last_place({vertices, {right, right_wall, left, left_wall, back}}, path).substr(0, 5), "e 0 1");
}

// The right one of these valleys is a line in which triangles cross. Edges come before it, though its triangles are lower than
// the edge's vertices.
TEST(soup_rules, of_an_edge_and_a_crossing_alike_the_edge_counts) {
  const std::vector<mesh::Vertex> vertices{{4, 0, 0}, {0, -8, 8}, {0, 8, 8}, {4, 8, -8}, {8, 4, -12}, {4, -4, -4}, {0, 0, 0}};
  const std::vector<mesh::Triangle> triangles{{6, 0, 3}, {6, 4, 2}, {6, 5, 0}, {6, 1, 5}, {6, 2, 1}};
  EXPECT_EQ(last_place({vertices, triangles}, {{0, 0, 0}, {2, 0, -5}}).substr(0, 5), "e 5 6");
}

// A line in which two triangles cross, and a third one that lies in the first one's plane and begins between two points of the
// line's grid: the point at which it begins is where its side meets the other one's plane.
TEST(soup_rules, a_line_may_be_met_by_a_triangle_in_the_plane_of_either_side) {
  const std::vector<mesh::Vertex> vertices{{-8192, -8192, 0}, {8192, -8192, 0},  {0, 8192, 0},      {-8192, 0, -8192},
                                           {8192, 0, -8192},  {0, 0, 8192},      {0x1p-11F, -1, 0}, {0x1p-11F, 1, 0},
                                           {5, 0, 0},         {0x1p-11F, 0, -1}, {0x1p-11F, 0, 1}};
  const mesh::Triangle level{0, 1, 2}, upright{3, 4, 5}, in_level{6, 8, 7}, in_upright{9, 8, 10};
  const std::vector<Position> path{
      {0x1p-13F, 0.5F, 0.5F}, {0x1p-11F + 0x1p-13F, -0.5F, -0.5F}, {0x1p-11F + 0x1p-13F, -0.5F, -0.5F}};
  for (const mesh::Triangle& third : {in_level, in_upright}) {
    EXPECT_NE(last_place({vertices, {level, upright, third}}, path), "");
    EXPECT_NE(last_place({vertices, {upright, level, third}}, path), "");
  }
}

// The ray in which they cross is in the middle of one, far from its sides.
TEST(soup_rules, triangles_may_cross_from_a_common_corner) {
  const std::vector<mesh::Vertex> vertices{{0, 0, 0}, {4, 3, 0}, {4, -3, 0}, {4, 0, 1}, {4, 0, -1}};
  const std::vector<Position> path{{0, 0, 0},        {2, 0.25F, -0.5F}, {2, -0.25F, -0.5F},
                                   {2, 0.5F, 0.25F}, {0, 0, 0},         {1, -0.25F, 0.125F}};
  EXPECT_NE(last_place({vertices, {{0, 1, 2}, {0, 3, 4}}}, path), "");
}

// A flight in the plane of a level triangle ends at its border. An upright one there lets it go above the level one, whose
// front that is; but below it is where the flight came from.
TEST(soup_rules, a_flight_along_the_surface_ends_on_the_side_that_it_came_from) {
  const mesh::TriangleMesh mesh{{{0, -4, 0}, {8, 0, 0}, {0, 4, 0}, {0, 0, 6}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto [triangle, is_behind, piece] =
      last_tick(mesh, {{-1, 0.5F, 0}, {2, 0.5F, 0}}, {mesh::Sides::both, mesh::Sides::front}).cell;
  EXPECT_EQ(triangle, 0U);
  EXPECT_TRUE(is_behind);
}

// Upright walls let a hand through to the right, above a level triangle and below. A flight that lands at their foot goes on in
// the cell of the lowest wall that leads on, though another one of that which it reaches is lower: of the piece in which it
// goes on, and of those that begin and end at its ray.
TEST(soup_rules, a_flight_along_the_surface_ends_where_the_surface_leads_on) {
  const std::vector<mesh::Vertex> vertices{{0, -8, 0}, {0, 8, 0}, {0, 0, 8}, {0, 0, -8}, {0, 0, 0}, {8, 0, 0}};
  const mesh::Triangle below{0, 3, 1}, above{0, 1, 2};
  for (const std::vector<mesh::Triangle>& level :
       {std::vector<mesh::Triangle>{{0, 5, 1}}, {{4, 5, 1}, {0, 4, 5}}, {{0, 5, 4}, {4, 1, 5}}}) {
    mesh::TriangleMesh mesh{vertices, {below, above}};
    mesh.triangles.insert(mesh.triangles.end(), level.begin(), level.end());
    std::vector<mesh::Sides> sides(mesh.triangles.size(), mesh::Sides::front);
    sides[2] = mesh::Sides::both;
    const auto [triangle, is_behind, piece] = last_tick(mesh, {{-1, 0, 0}, {2, 0, 0}}, sides).cell;
    EXPECT_EQ(triangle, 2U);
    EXPECT_FALSE(is_behind);
  }
}

// Two walls meet in an upright edge on a floor that they cross, and a hand pulls into the corner and down: along both walls
// alike. Of two such lines that with the lower triangle counts, and of one triangle's lines that with the lower one of another
// plane, however low the others in the floor are.
TEST(soup_rules, of_two_crossings_alike_the_lower_triangles_count) {
  const std::vector<mesh::Vertex> vertices{{0, 0, 0},    {16, 16, 0}, {-16, 16, 0}, {0, -16, 0}, {0, 0, 8}, {4, 16, -4},
                                           {4, -16, -4}, {4, 4, 0},   {-4, 4, 0},   {-4, -4, 0}, {4, -4, 0}};
  const mesh::Triangle floor{1, 2, 3}, wall{0, 4, 5}, other_wall{0, 4, 6}, under_wall{0, 7, 8}, under_other_wall{0, 9, 10};
  const std::vector<Position> path{{-1, 0, 1}, {0, 0, 0}, {2, 0, -1}};
  EXPECT_EQ(last_place({vertices, {floor, under_wall, under_other_wall, other_wall, wall}}, path).substr(0, 5), "c 0 3");
  EXPECT_EQ(last_place({vertices, {floor, under_wall, under_other_wall, wall, other_wall}}, path).substr(0, 5), "c 0 3");
  EXPECT_EQ(last_place({vertices, {under_wall, under_other_wall, other_wall, wall, floor}}, path).substr(0, 5), "c 0 3");
  EXPECT_EQ(last_place({vertices, {under_other_wall, under_wall, wall, other_wall, floor}}, path).substr(0, 5), "c 0 3");
}

// An upright triangle begins inside of a level one, whose directions begin and end at the line in which they cross. Of the two
// wedges beside the level wall that one counts which follows it counter-clockwise.
TEST(soup_rules, of_two_wedges_beside_one_wall_the_one_that_follows_counts) {
  const std::vector<mesh::Vertex> vertices{{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}, {0, 0, 0}, {4, 0, 4}, {4, 0, -4}};
  const std::vector<Position> path{{-1, 0, 1}, {0, 0, 0}, {2, 0, -1}};
  for (const mesh::Triangle& level : {mesh::Triangle{0, 1, 2}, {0, 2, 1}})
    for (const mesh::Triangle& upright : {mesh::Triangle{3, 4, 5}, {3, 5, 4}})
      EXPECT_EQ(last_place({vertices, {level, upright}}, path).substr(0, 7), "c 0 1 0");
}

// The two valleys again. Along the right one lie two edges, of which the lower pair counts; and one ends at the vertex from
// behind, which is no edge of the valley.
TEST(soup_rules, of_the_edges_along_a_ray_the_lower_names_count) {
  const mesh::Vertex left{4, -4, -4}, right{4, 4, -4}, farther{8, 8, -8}, ridge{4, 0, 0}, left_top{0, -8, 8},
      right_top{0, 8, 8};
  const std::vector<Position> path{{1, 0, 1}, {0, 0, 0}, {2, 0, -5}};
  const auto place = [&](const std::vector<mesh::Vertex>& vertices, std::vector<mesh::Triangle> triangles) {
    const std::string its = last_place({vertices, triangles}, path);
    std::ranges::reverse(triangles);
    EXPECT_EQ(last_place({vertices, triangles}, path).substr(0, 5), its.substr(0, 5));
    return its.substr(0, 5);
  };
  const std::vector<mesh::Vertex> twice{{0, 0, 0}, right, left, ridge, left_top, right_top, farther};
  EXPECT_EQ(place(twice, {{0, 2, 3}, {0, 3, 6}, {0, 4, 2}, {0, 1, 5}, {0, 5, 4}}), "e 0 1");
  EXPECT_EQ(place(twice, {{0, 2, 3}, {0, 3, 1}, {0, 4, 2}, {0, 6, 5}, {0, 5, 4}}), "e 0 1");
  const std::vector<mesh::Vertex> behind{{-4, -4, 4}, left, right, ridge, left_top, {0, 0, 0}, right_top, {-8, 0, -8}};
  for (const mesh::Triangle& ends : {mesh::Triangle{0, 5, 7}, {7, 5, 0}})
    EXPECT_EQ(place(behind, {{5, 1, 3}, {5, 3, 2}, {5, 4, 1}, {5, 2, 6}, {5, 6, 4}, ends}), "e 1 5");
}

// A rest nearer to a side than half a step of the grid is kept inside of it; of equal weights at the third side the first one
// gives way.
TEST(soup_rules, a_rest_is_kept_inside_of_its_triangle) {
  const mesh::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto place = [&](float x, float y) { return last_place(mesh, {{0.25F, 0.25F, 1}, {x, y, -1}}); };
  EXPECT_EQ(place(0.5F - 0x1p-25F, 0.5F), "t 0 8388607 8388608");
  EXPECT_EQ(place(0.25F - 0x1p-26F, 0.75F), "t 0 4194304 12582911");
  EXPECT_EQ(place(0.25F, 0x1p-26F), "t 0 4194304 1");
  EXPECT_EQ(place(0x1p-26F, 0.25F), "t 0 1 4194304");
}

// A wall stands between a rest and the nearest point of the grid, and lets nothing through in one direction: either way keeps
// the foot.
TEST(soup_rules, a_rest_is_a_foot_where_a_wall_stops_the_way_to_the_grid_or_from_it) {
  constexpr float kWall = 0x1p-6F + 0x1p-27F;
  mesh::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kWall, -1, -1}, {kWall, 2, -1}, {kWall, 0.5F, 8}}, {{0, 1, 2}}};
  const std::vector<Position> path{{0.2F, 0.25F, 1}, {0x1p-6F + 0x1p-26F, 0.25F, -1}};
  EXPECT_EQ(last_place(mesh, path), "t 0 262144 4194304");
  for (const mesh::Triangle& wall : {mesh::Triangle{3, 4, 5}, {3, 5, 4}}) {
    mesh.triangles.resize(1);
    mesh.triangles.push_back(wall);
    EXPECT_EQ(last_place(mesh, path, {mesh::Sides::both, mesh::Sides::front}), "q t 0");
  }
}

// All corners at a vertex have one normal, but a spike that stands on it is another part of its directions: there is no
// shading.
TEST(soup_rules, a_vertex_of_two_parts_is_not_shaded) {
  const mesh::TriangleMesh fan{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {-4, 0, 0}, {0, -4, 0}, {1, 0, 4}, {-1, 0, 4}},
                               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {0, 5, 6}}};
  const mesh::Normal aslant{0.6F, 0, 0.8F};
  EXPECT_EQ(last_place(fan, {{1, 0.5F, 2}, {0, 0, 0}, {0, 0, -1}}, {mesh::Sides::both},
                       mesh::CornerNormals(5, {aslant, aslant, aslant})),
            "v 0");
}

}  // namespace
}  // namespace forceshade
