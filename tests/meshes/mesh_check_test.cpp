// SPDX-License-Identifier: BSD-3-Clause
// The check of a mesh, with the faces and vertices that its findings name.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include "forceshade/meshes.h"
#include "rendering/meshes/box_tree.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {
namespace {

// The words about a mesh; empty if it is one.
std::string words(TriangleMesh mesh) {
  const auto checked = check(std::move(mesh));
  const auto* findings = std::get_if<Findings>(&checked);
  return findings == nullptr ? "" : findings->words();
}

const std::vector<Vertex> kSix{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 1}, {2, 0, 4}, {2, 1, 0}};

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b, const Vertex& moved) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  for (const Vertex& v : b.vertices) a.vertices.push_back({v[0] + moved[0], v[1] + moved[1], v[2] + moved[2]});
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

TEST(mesh_check, names_what_is_wrong) {
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<TriangleMesh, std::string>> cases{
      {{kSix, {{0, 1, 2}}}, ""},
      {{kSix, {}}, "there is no face, or more than 268435456 faces or vertices\n"},
      {{kSix, {{0, 1, 2}, {1, 0, 3}}}, ""},
      {{{{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "vertex 1 has a coordinate that is no number within 10000 mm\n"},
      {{{{0, 0, 0}, {1, 0, 0}, {0, 1, infinity}}, {{0, 1, 2}}},
       "vertex 2 has a coordinate that is no number within 10000 mm\n"},
      {{{{0, 0, 0}, {10001, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "vertex 1 has a coordinate that is no number within 10000 mm\n"},
      {{{{0, 0, 0}, {10000, 0, 0}, {0, -10000, 0}}, {{0, 1, 2}}}, ""},
      {{kSix, {{0, 1, 2}, {0, 6, 1}}}, "face 1 has vertex 6, which is not there\n"},
      {{kSix, {{0, 1, 1}}}, "face 0 has vertex 1 twice\n"},
      {{kSix, {{2, 1, 2}}}, "face 0 has vertex 2 twice\n"},
      {{kSix, {{0, 0, 2}}}, "face 0 has vertex 0 twice\n"},
      {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}, "face 0 has no area: its vertices 0, 1 and 2 lie on a line\n"},
      {{{{0, 0, 0}, {0x1.fffffep-31F, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
       "face 0 has no area: its vertices 0, 1 and 2 lie on a line\n"},
      {{{{0, 0, 0}, {0x1p-30F, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, ""},
      {{kSix, {{0, 1, 2}, {0, 2, 1}}}, "faces 0 and 1 have the same vertices 0, 1 and 2\n"},
      {{kSix, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}, "the edge of vertices 0 and 1 has more than two faces: 0, 1 and 2\n"},
      {{kSix, {{0, 1, 2}, {0, 1, 3}}},
       "faces 0 and 1 run along their edge, of vertices 0 and 1, in the same direction: one of them is turned over\n"},
      {{kSix, {{0, 1, 2}, {1, 0, 5}}}, "faces 0 and 1 are folded onto each other at their edge, of vertices 0 and 1\n"},
      {{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 1, -1}, {2, 1, 1}, {6, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}},
       "faces 0 and 1 meet, but have no vertex in common\n"},
      // A vertex in another face's edge, and at another face's vertex.
      {{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 0, 0}, {3, -3, 0}, {1, -3, 0}}, {{0, 1, 2}, {3, 5, 4}}},
       "faces 0 and 1 meet, but have no vertex in common\n"},
      {{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {-0.0F, 0, 0}, {-4, 0, 1}, {-2, -3, 1}}, {{0, 1, 2}, {3, 4, 5}}},
       "faces 0 and 1 meet, but have no vertex in common\n"},
      // Two faces at one vertex, with no edge between them.
      {{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {-4, 0, 0}, {-2, -3, 0}}, {{0, 1, 2}, {0, 3, 4}}},
       "faces 0 and 1 meet at vertex 0, but no edges there lead from one to the other: expected one fan\n"}};
  for (const auto& [mesh, expected] : cases) EXPECT_EQ(words(mesh), expected);
}

TEST(mesh_check, refuses_two_parts_at_one_vertex_and_neighbours_that_cross) {
  // Two tetrahedra with one vertex in common.
  const TriangleMesh fans{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}, {-10, 0, 0}, {0, -10, 0}, {0, 0, -10}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}}};
  EXPECT_EQ(words(fans), "faces 0 and 4 meet at vertex 0, but no edges there lead from one to the other: expected one fan\n");
  // A fan whose last face goes through the first one.
  const TriangleMesh fan{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {-2, 1, 1}, {5, 1, -1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};
  EXPECT_EQ(words(fan), "faces 0 and 2 have vertex 0 in common, but meet elsewhere, too\n");
  EXPECT_TRUE(std::holds_alternative<JoinedMesh>(check_joints(fan)));
  EXPECT_TRUE(std::holds_alternative<Findings>(check_joints(fans)));
}

TEST(mesh_check, gives_the_mesh_as_it_is_read) {
  const TriangleMesh one{{{0, 0, 0}, {0x1p-31F, 4, 0}, {2, 3, -0.0F}}, {{0, 1, 2}}};
  const auto checked = std::get<CheckedMesh>(check(one));
  EXPECT_TRUE(checked.is_regular());
  EXPECT_EQ(checked.mesh().triangles, one.triangles);
  EXPECT_EQ(checked.mesh().vertices, (std::vector<Vertex>{{0, 0, 0}, {0, 4, 0}, {2, 3, 0}}));
  EXPECT_FALSE(std::signbit(checked.mesh().vertices[2][2]));
}

TEST(mesh_check, lists_the_first_of_many_faults_and_counts_the_rest) {
  TriangleMesh mesh{kSix, {}};
  for (std::uint32_t i = 0; i < 100; ++i) mesh.triangles.push_back({0, 1, 1});
  mesh.triangles.push_back({0, 1, 9});
  const auto checked = check(mesh);
  const auto& findings = std::get<Findings>(checked);
  ASSERT_EQ(findings.listed.size(), 21U);
  EXPECT_EQ(findings.listed[0], (Finding{Fault::index, {100}, {9}}));
  for (std::uint32_t i = 0; i < 20; ++i) EXPECT_EQ(findings.listed[i + 1], (Finding{Fault::vertex_twice, {i}, {1}}));
  EXPECT_TRUE(findings.words().ends_with("face 19 has vertex 1 twice\nand 80 more of this kind\n"));
}

TEST(mesh_check, names_the_lines_of_faces_once_each) {
  const auto checked = check({kSix, {{0, 1, 2}, {0, 1, 3}}});
  const auto& findings = std::get<Findings>(checked);
  for (const auto& [lines, place] : {std::pair{std::array<std::uint64_t, 2>{7, 9}, "lines 7 and 9: faces 0 and 1 run "},
                                     {{7, 7}, "line 7: faces 0 and 1 run "}})
    EXPECT_TRUE(findings.words(lines).starts_with(place)) << findings.words(lines);
}

// The tree of boxes must leave out no pair, and give none twice: against every pair, on loose triangles of very different
// sizes.
TEST(mesh_check, finds_each_pair_that_meets) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-3, 3), size(-1, 1);
  std::uint64_t meetings = 0;
  for (const std::uint32_t count : {2U, 3U, 4U, 5U, 17U, 400U, 1500U}) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float scale = std::ldexp(1.0F, -static_cast<int>(random() % 6)) * (i % 50 == 0 ? 20.0F : 1.0F);
      const Vertex middle{place(random), place(random), place(random)};
      for (int k = 0; k < 3; ++k)
        mesh.vertices.push_back(
            {middle[0] + scale * size(random), middle[1] + scale * size(random), middle[2] + scale * size(random)});
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    std::uint64_t expected = 0;
    const auto points = [&](std::uint32_t i) {
      return TrianglePoints{mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2]};
    };
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t k = 0; k < i; ++k) expected += meet(points(i), points(k)) ? 1 : 0;
    meetings += expected;
    const auto checked = check(mesh);
    const auto* findings = std::get_if<Findings>(&checked);
    EXPECT_EQ(findings == nullptr ? 0 : findings->counts[static_cast<std::size_t>(Fault::meeting)], expected) << count;
  }
  std::printf("%llu pairs meet\n", static_cast<unsigned long long>(meetings));
  EXPECT_GT(meetings, 500U);
}

// Enough triangles for several threads: what is listed does not depend on which of them finds it.
TEST(mesh_check, finds_the_same_with_several_threads) {
  const TriangleMesh crossing = joined(icosphere(30, 10), icosphere(30, 10), {5, 0, 0});
  const auto first = check(crossing), second = check(crossing);
  const auto &a = std::get<Findings>(first), &b = std::get<Findings>(second);
  EXPECT_EQ(a.listed, b.listed);
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_EQ(a.listed.size(), Findings::kListed);
  EXPECT_GT(a.counts[static_cast<std::size_t>(Fault::meeting)], 50U);
  EXPECT_EQ(words(joined(icosphere(30, 10), icosphere(30, 10), {20.001F, 0, 0})), "");
  EXPECT_EQ(words(joined(icosphere(30, 10), icosphere(30, 5), {0, 0, 0})), "");
}

// A fan of triangles, of which every two have boxes that meet.
TriangleMesh large_fan(std::uint32_t triangles) {
  TriangleMesh fan{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i <= triangles; ++i) {
    const double angle = 6.0 * i / triangles;
    fan.vertices.push_back({static_cast<float>(50 * std::cos(angle)), static_cast<float>(50 * std::sin(angle)), 0});
    if (i > 0) fan.triangles.push_back({0, i, i + 1});
  }
  return fan;
}

// A task of a fan of a million triangles takes half a minute.
TEST(mesh_check, reports_within_a_task_that_has_many_pairs_and_can_be_stopped_there) {
  const TriangleMesh fan = large_fan(4000);
  const std::size_t tasks = BoxTree(fan).tasks();
  std::atomic<bool> stop = false;
  std::size_t reports = 0;
  EXPECT_TRUE(std::holds_alternative<CheckedMesh>(check(fan, Monitor([&](double) { ++reports; }, stop))));
  EXPECT_GE(reports, tasks + 4000 * 3999 / 2 / 65536);
  EXPECT_THROW(check(fan, Monitor([&](double) { stop = true; }, stop)), Interrupted);
}

// On one thread and on several.
TEST(mesh_check, reports_how_far_it_is_and_can_be_stopped) {
  for (const std::uint32_t cells : {8U, 40U}) {
    const TriangleMesh mesh = icosphere(cells, 50);
    std::atomic<bool> stop = false;
    double last = 0;
    const Monitor monitor(
        [&](double done) {
          EXPECT_GE(done, last);
          last = done;
        },
        stop);
    EXPECT_TRUE(std::holds_alternative<CheckedMesh>(check(mesh, monitor)));
    EXPECT_EQ(last, 1);
    stop = true;
    EXPECT_THROW(check(mesh, monitor), Interrupted);
  }
}

}  // namespace
}  // namespace forceshade::mesh
