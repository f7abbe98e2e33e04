// SPDX-License-Identifier: BSD-3-Clause
// What a mesh that is not regular has, where borders come near each other, and what is joined.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "forceshade/meshes.h"
#include "rendering/meshes/distances.h"
#include "rendering/meshes/insides.h"
#include "rendering/meshes/make.h"

namespace forceshade::mesh {
namespace {

// Two squares of 10 mm side by side, each of two triangles, the second one moved by `gap` along x.
TriangleMesh plates(float gap) {
  return {{{0, 0, 0},
           {10, 0, 0},
           {10, 10, 0},
           {0, 10, 0},
           {10 + gap, 0, 0},
           {20 + gap, 0, 0},
           {20 + gap, 10, 0},
           {10 + gap, 10, 0}},
          {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
}

// A cube of 12 triangles, of which the last two have vertices of their own, moved outwards by `gap`.
TriangleMesh cracked_cube(float gap) {
  TriangleMesh cube = mesh::cube(10);
  for (std::size_t i = 10; i < 12; ++i)
    for (std::uint32_t& v : cube.triangles[i]) {
      Vertex moved = cube.vertices[v];
      for (float& x : moved) x += std::copysign(gap, x);
      v = static_cast<std::uint32_t>(cube.vertices.size());
      cube.vertices.push_back(moved);
    }
  return cube;
}

std::map<std::string, std::uint64_t> counts_of(const Irregularities& found) {
  std::map<std::string, std::uint64_t> counts;
  for (std::size_t i = 0; i < found.kinds.size(); ++i)
    if (found.kinds[i].count > 0) counts[std::string(kIrregularityNames[i])] = found.kinds[i].count;
  return counts;
}

using Counts = std::map<std::string, std::uint64_t>;

TEST(irregular_meshes, each_kind_is_counted_by_itself) {
  const Triangle base{0, 1, 2};
  const std::vector<Vertex> corners{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  const auto with = [&](std::vector<Vertex> more, std::vector<Triangle> triangles) {
    TriangleMesh mesh{corners, {base}};
    mesh.vertices.insert(mesh.vertices.end(), more.begin(), more.end());
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    return counts_of(irregularities_of(mesh));
  };
  EXPECT_EQ(with({}, {}), Counts{});
  EXPECT_EQ(with({{4, 0, 0}}, {{0, 3, 1}}), (Counts{{"faces without area", 1}}));
  EXPECT_EQ(with({}, {{0, 2, 1}}), (Counts{{"faces with the vertices of a face before them", 1}}));
  EXPECT_EQ(with({}, {{0, 1, 2}}),
            (Counts{{"faces with the vertices of a face before them", 1}, {"edges with faces turned over", 3}}));
  EXPECT_EQ(with({{4, 4, 4}}, {{0, 1, 3}}), (Counts{{"edges with faces turned over", 1}}));
  EXPECT_EQ(with({{4, -4, 4}, {4, -4, 0}}, {{1, 0, 3}, {1, 0, 4}}), (Counts{{"edges with more than two faces", 1}}));
  EXPECT_EQ(with({{-8, 0, 0}, {0, -8, 0}}, {{0, 3, 4}}), (Counts{{"vertices with several fans", 1}}));
  // A corner inside the other, a side inside it, a corner inside its edge, an edge across its edge in one plane.
  EXPECT_EQ(with({{1, 1, 0}, {4, 1, 4}, {1, 4, 4}}, {{3, 4, 5}}), (Counts{{"pairs of faces that touch", 1}}));
  EXPECT_EQ(with({{1, 1, 0}, {2, 1, 0}, {1, 1, 4}}, {{3, 4, 5}}), (Counts{{"pairs of faces that touch", 1}}));
  EXPECT_EQ(with({{4, 0, 0}, {5, -4, 0}, {3, -4, 0}}, {{3, 4, 5}}), (Counts{{"pairs of faces that touch", 1}}));
  EXPECT_EQ(with({{2, 0, 0}, {5, 0, 0}, {3, -4, 0}}, {{3, 4, 5}}), (Counts{{"pairs of faces that touch", 1}}));
  EXPECT_EQ(with({{1, 1, -1}, {2, 1, -1}, {1, 1, 4}}, {{3, 4, 5}}), (Counts{{"pairs of faces that cross", 1}}));
  EXPECT_EQ(with({{1, 1, -1}, {1, 1, 4}}, {{0, 3, 4}}),
            (Counts{{"pairs of faces that cross", 1}, {"vertices with several fans", 1}}))
      << "a common vertex";
  EXPECT_EQ(with({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}, {{3, 4, 5}}), (Counts{{"pairs of faces that coincide", 1}}));
  EXPECT_EQ(with({{7, 7, 0}}, {{1, 0, 3}}), (Counts{{"pairs of faces that coincide", 1}})) << "folded onto each other";
}

TEST(irregular_meshes, vertices_with_equal_coordinates_count_as_one) {
  const Irregularities found = irregularities_of(cracked_cube(0));
  EXPECT_EQ(counts_of(found), Counts{});
  EXPECT_EQ(found.equal_vertices, 6U);
  EXPECT_EQ(borders_of(cracked_cube(0)).edges, 0U);
  EXPECT_FALSE(std::get<CheckedMesh>(check_any(cracked_cube(0))).is_regular());
  EXPECT_EQ(usual_sides(std::get<CheckedMesh>(check_any(cracked_cube(0)))), Sides::front);
  EXPECT_EQ(usual_sides(std::get<CheckedMesh>(check_any(cracked_cube(0.5F)))), Sides::both);
}

// The insides of two triangles meet only if the triangles do, and if they cross with room to spare on every side, they meet.
TEST(irregular_meshes, insides_meet_where_triangles_do) {
  std::mt19937 random(1);
  const auto coordinate = [&] { return static_cast<float>(random() % 5); };
  std::array<int, 2> outside{}, inside{};
  for (int i = 0; i < 20000; ++i) {
    TrianglePoints s{}, t{};
    for (TrianglePoints* each : {&s, &t})
      for (Vertex& corner : *each) corner = {coordinate(), coordinate(), i % 2 == 0 ? 0 : coordinate()};
    if (!has_area(s) || !has_area(t)) continue;
    const bool can_meet = meet(s, t), is_inside = insides_meet(s, t);
    ASSERT_EQ(is_inside, insides_meet(t, s));
    ASSERT_EQ(is_inside, insides_meet({s[1], s[2], s[0]}, {t[1], t[0], t[2]}));
    ASSERT_TRUE(can_meet || !is_inside);
    ++(is_inside ? inside : outside)[static_cast<std::size_t>(i % 2)];
    // A triangle half as large around its middle is inside it; here 6 times as large, so that it is exact.
    const auto smaller = [](const TrianglePoints& whole) {
      TrianglePoints small = whole;
      for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::size_t axis = 0; axis < 3; ++axis)
          small[corner][axis] = whole[0][axis] + whole[1][axis] + whole[2][axis] + 3 * whole[corner][axis];
      return small;
    };
    if (meet(smaller(s), smaller(t))) {
      ASSERT_TRUE(is_inside) << i;
    }
  }
  for (const int count : {outside[0], outside[1], inside[0], inside[1]}) EXPECT_GT(count, 100);
}

TEST(irregular_meshes, cracks_are_borders_that_come_near_without_touching) {
  EXPECT_EQ(borders_of(plates(0.5F)).edges, 8U);
  EXPECT_DOUBLE_EQ(borders_of(plates(0.5F)).length, 80);
  EXPECT_TRUE(borders_of(plates(0.5F)).cracks.empty());
  EXPECT_TRUE(borders_of(plates(0.5F), 0.5F).cracks.empty()) << "as wide as the length";
  const Borders near = borders_of(plates(0.5F), 0.50001F);
  // The two long sides, and the ends of the others with these and with each other: each pair of triangles once.
  ASSERT_EQ(near.cracks.size(), 3U);
  EXPECT_EQ(near.cracks[0].triangles, (std::array{0U, 2U}));
  EXPECT_EQ(near.cracks[1].triangles, (std::array{0U, 3U}));
  EXPECT_EQ(near.cracks[2].triangles, (std::array{1U, 3U}));
  for (const Crack& crack : near.cracks) EXPECT_DOUBLE_EQ(crack.distance, 0.5);
  EXPECT_TRUE(borders_of(plates(0), 1).cracks.empty()) << "joined";
  EXPECT_FALSE(borders_of(cracked_cube(1e-4F), 1e-3F).cracks.empty());
  EXPECT_TRUE(borders_of(icosphere(4, 10), 1).cracks.empty()) << "no border";
  // Two edges whose insides are nearest.
  const TriangleMesh across{{{-5, 0, 0}, {5, 0, 0}, {0, 0, -5}, {0, -5, 0.25F}, {0, 5, 0.25F}, {0, 0, 5}},
                            {{0, 1, 2}, {3, 4, 5}}};
  ASSERT_EQ(borders_of(across, 0.26F).cracks.size(), 1U);
  EXPECT_DOUBLE_EQ(borders_of(across, 0.26F).cracks[0].distance, 0.25);
}

TEST(irregular_meshes, distances_of_edges_are_the_least) {
  std::mt19937 random(2);
  const auto coordinate = [&] { return static_cast<float>(random() % 9) / 4; };
  for (int i = 0; i < 2000; ++i) {
    std::array<Vertex, 4> p{};
    for (Vertex& point : p) point = {coordinate(), coordinate(), coordinate()};
    if (p[0] == p[1] || p[2] == p[3]) continue;
    const double distance = root(squared_distance({p[0], p[1]}, {p[2], p[3]}));
    double least = 1e9;
    constexpr int kSteps = 64;
    for (int a = 0; a <= kSteps; ++a)
      for (int b = 0; b <= kSteps; ++b) {
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double s = p[0][axis] + double(a) / kSteps * (double(p[1][axis]) - double(p[0][axis])),
                       t = p[2][axis] + double(b) / kSteps * (double(p[3][axis]) - double(p[2][axis]));
          square += (s - t) * (s - t);
        }
        least = std::min(least, std::sqrt(square));
      }
    ASSERT_LE(distance, least + 1e-12) << i;
    ASSERT_GE(distance, least - 4.0 / kSteps) << i;
  }
}

TEST(irregular_meshes, cracks_within_a_length_are_joined_and_nothing_else_moves) {
  const TriangleMesh cracked = cracked_cube(1e-3F);
  const Repaired untouched = repair(cracked, 1e-3F);  // the corners are √3 times as far
  EXPECT_TRUE(untouched.moved.empty());
  EXPECT_EQ(untouched.mesh.triangles, repair(cracked).mesh.triangles);
  const Repaired joined = repair(cracked, 2e-3F);
  ASSERT_EQ(joined.moved.size(), 4U);
  for (const auto& [vertex, onto, distance] : joined.moved) {
    EXPECT_GE(vertex, 8U);
    EXPECT_LT(onto, 8U);
    EXPECT_NEAR(distance, 1e-3 * std::sqrt(3), 1e-6);
  }
  EXPECT_EQ(joined.mesh.vertices, repair(cracked).mesh.vertices) << "those that are moved onto stay";
  EXPECT_TRUE(std::holds_alternative<CheckedMesh>(check(joined.mesh)));
  EXPECT_EQ(facts_of(std::get<CheckedMesh>(check(joined.mesh))).rim_edges, 0U);
  EXPECT_DOUBLE_EQ(facts_of(std::get<CheckedMesh>(check(joined.mesh))).volume, 1000);
  ASSERT_EQ(joined.done.size(), 2U) << "equal vertices are joined before";
  EXPECT_TRUE(joined.done[1].starts_with("moved 4 vertices of borders onto another within 0.002 mm: 8 onto "))
      << joined.done[1];
}

TEST(irregular_meshes, the_nearest_vertex_that_stays_is_joined_with) {
  // Three plates whose corners are 0.25 mm apart in a row: the second goes to the first, and the third is too far from that.
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float x = 0.25F * static_cast<float>(i), z = 4 * static_cast<float>(i);
    for (const Vertex& corner : {Vertex{x, 0, 0}, Vertex{x + 1, 5 + z, 0}, Vertex{x + 1, 5 + z, 3}})
      mesh.vertices.push_back(corner);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Repaired joined = repair(mesh, 0.25F);
  ASSERT_EQ(joined.moved.size(), 1U);
  EXPECT_EQ(joined.moved[0].vertex, 3U);
  EXPECT_EQ(joined.moved[0].onto, 0U);
  EXPECT_EQ(joined.moved[0].distance, 0.25);
  EXPECT_TRUE(repair(mesh, std::nextafter(0.25F, 0.0F)).moved.empty()) << "decided exactly";
}

TEST(irregular_meshes, a_face_is_split_at_vertices_beside_its_edge) {
  // The second plate has two vertices more on its side at the crack, not in the order of their numbers.
  TriangleMesh junction = plates(1e-4F);
  junction.vertices.push_back({10 + 1e-4F, 7, 0});
  junction.vertices.push_back({10 + 1e-4F, 4, 0});
  junction.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 9}, {9, 5, 8}, {8, 5, 6}, {8, 6, 7}};
  const Repaired joined = repair(junction, 1e-3F);
  EXPECT_EQ(joined.moved.size(), 2U);
  EXPECT_EQ(joined.mesh.vertices, repair(junction).mesh.vertices);
  EXPECT_EQ(joined.mesh.triangles,
            (std::vector<Triangle>{{1, 9, 0}, {9, 8, 0}, {8, 2, 0}, {0, 2, 3}, {1, 5, 9}, {9, 5, 8}, {8, 5, 6}, {8, 6, 2}}));
  ASSERT_EQ(joined.split.size(), 2U);
  EXPECT_EQ(joined.split[0].triangle, 0U);
  EXPECT_EQ(joined.split[0].vertex, 9U);
  EXPECT_NEAR(joined.split[1].distance, 1e-4, 1e-6);
  ASSERT_EQ(joined.done.size(), 2U);
  EXPECT_TRUE(
      joined.done[1].starts_with("split faces at 2 vertices of borders beside their edges within 0.001 mm: face 0 at 9, "))
      << joined.done[1];
  EXPECT_EQ(borders_of(joined.mesh).edges, 6U) << "all around alone";
  EXPECT_TRUE(std::holds_alternative<CheckedMesh>(check(joined.mesh)));
}

TEST(irregular_meshes, a_face_is_split_at_all_its_edges_and_on_them) {
  // Each side of a triangle has a vertex of another one at its middle: on it, within the length, and beyond it.
  const TriangleMesh mesh{{{0, 0, 0},
                           {8, 0, 0},
                           {0, 8, 0},
                           {4, 0, 0},
                           {4, -4, 0},
                           {3, -4, 0},
                           {-0.25F, 4, 0},
                           {-4, 4, 0},
                           {-4, 3, 0},
                           {4.5F, 4.5F, 0},
                           {8, 8, 0},
                           {8, 7, 0}},
                          {{0, 1, 2}, {3, 4, 5}, {6, 8, 7}, {9, 11, 10}}};
  const Repaired joined = repair(mesh, 0.25F);
  ASSERT_EQ(joined.split.size(), 2U);
  EXPECT_EQ(joined.split[0].vertex, 3U);
  EXPECT_EQ(joined.split[0].distance, 0);
  EXPECT_EQ(joined.split[1].vertex, 6U);
  EXPECT_EQ(joined.split[1].distance, 0.25);
  EXPECT_EQ(joined.mesh.triangles.size(), 6U);
  EXPECT_EQ(repair(mesh, std::nextafter(0.25F, 0.0F)).split.size(), 1U) << "decided exactly";
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [a, b, c] = joined.mesh.triangles[i];
    const auto& v = joined.mesh.vertices;
    area +=
        (double{v[b][0]} - v[a][0]) * (double{v[c][1]} - v[a][1]) - (double{v[b][1]} - v[a][1]) * (double{v[c][0]} - v[a][0]);
  }
  EXPECT_EQ(area, 66) << "64, and 2 of what the edge takes in";
}

TEST(irregular_meshes, a_length_that_would_spoil_a_face_is_refused) {
  const auto refusal = [](const TriangleMesh& mesh, float length) {
    try {
      repair(mesh, length);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(plates(0.5F), 9), "");
  EXPECT_TRUE(refusal(plates(0.5F), 10).starts_with("face 0 would lose its area; expected a length below the sides"))
      << refusal(plates(0.5F), 10);
  // Its tip would go over its base.
  const TriangleMesh tip{{{-0.25F, 0, 0}, {-8, 0, 5}, {-8, 4, 5}, {0, -1, 0}, {0, 1, 0}, {0.75F, 0, 0}},
                         {{0, 1, 2}, {3, 5, 4}}};
  EXPECT_TRUE(refusal(tip, 1).starts_with("face 1 would turn by a right angle or more")) << refusal(tip, 1);
  EXPECT_EQ(refusal(tip, std::nextafter(1.0F, 0.0F)), "");
  // A vertex of another face is beside the base of a low one, and over the face behind that.
  const TriangleMesh low{{{0, 0, 0}, {8, 0, 0}, {4, 0.25F, 0}, {4, 8, 0}, {2, 0.375F, 0}, {2, 4, 4}, {1, 4, 4}},
                         {{0, 1, 2}, {2, 1, 3}, {0, 2, 3}, {4, 5, 6}}};
  EXPECT_TRUE(refusal(low, 0.375F).starts_with("face 0 would turn by a right angle or more")) << refusal(low, 0.375F);
  EXPECT_EQ(refusal(low, std::nextafter(0.375F, 0.0F)), "");
}

}  // namespace
}  // namespace forceshade::mesh
