// SPDX-License-Identifier: BSD-3-Clause
// Repair: what it does is listed, and what it gives passes the check where these faults were all.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"

namespace forceshade::mesh {
namespace {

std::string words(TriangleMesh mesh) {
  const auto checked = check(std::move(mesh));
  const auto* findings = std::get_if<Findings>(&checked);
  return findings == nullptr ? "" : findings->words();
}

using Lines = std::vector<std::string>;

TEST(mesh_repair, changes_nothing_in_a_mesh) {
  for (const TriangleMesh& mesh : {icosphere(4, 50), cube(1), bump(15.24, 25.4, 100, 10)}) {
    const Repaired repaired = repair(mesh);
    EXPECT_EQ(repaired.done, Lines{});
    EXPECT_EQ(repaired.mesh.vertices, mesh.vertices);
    EXPECT_EQ(repaired.mesh.triangles, mesh.triangles);
  }
}

TEST(mesh_repair, lists_what_it_did) {
  const TriangleMesh mesh{
      {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}, {4, 0, 0}, {std::nanf(""), 0, 0}, {1, 0, 0}, {0x1p-40F, -0.0F, 0}},
      {{0, 1, 2}, {7, 4, 3}, {0, 1, 5}, {0, 1, 1}, {0, 6, 1}, {2, 1, 0}, {0, 9, 1}, {0, 4, 1}}};
  const Repaired repaired = repair(mesh);
  EXPECT_EQ(repaired.done, (Lines{"dropped 1 vertices with a coordinate that is no number within 10000 mm",
                                  "joined 2 vertices to another with the same coordinates",
                                  "dropped 2 faces with a vertex that does not exist: 2, 6",
                                  "dropped 2 faces with a vertex twice: 3, 7", "dropped 1 faces without area: 4",
                                  "dropped 1 faces with the vertices of a face before them: 5", "turned 1 faces over: 1"}));
  EXPECT_EQ(repaired.mesh.vertices, (std::vector<Vertex>{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 0}, {1, 0, 0}}));
  EXPECT_EQ(repaired.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 1}}));
  EXPECT_EQ(words(repaired.mesh), "");
}

// Triangles with vertices of their own, in any order of the corners, some turned over, some twice.
TEST(mesh_repair, makes_a_mesh_of_loose_triangles) {
  std::mt19937 random(9);
  for (const TriangleMesh& mesh : {icosphere(5, 50), torus(20, 5, 12, 8), bump(15.24, 25.4, 100, 8)}) {
    TriangleMesh loose;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Triangle t = mesh.triangles[i];
      if (i == 0 || random() % 4 == 0) std::swap(t[0], t[1]);
      for (int copies = random() % 5 == 0 ? 2 : 1; copies > 0; --copies) {
        const auto first = static_cast<std::uint32_t>(loose.vertices.size());
        for (const std::uint32_t v : t) loose.vertices.push_back(mesh.vertices[v]);
        loose.triangles.push_back({first, first + 1, first + 2});
      }
    }
    EXPECT_NE(words(loose), "");
    const Repaired repaired = repair(loose);
    EXPECT_EQ(words(repaired.mesh), "");
    ASSERT_EQ(repaired.mesh.triangles.size(), mesh.triangles.size());
    // Fewer than half were turned over, the first face among them: all are as they were.
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Triangle t = repaired.mesh.triangles[i];
      bool is_same = false;
      for (int turn = 0; turn < 3; ++turn) {
        is_same |= repaired.mesh.vertices[t[0]] == mesh.vertices[mesh.triangles[i][0]] &&
                   repaired.mesh.vertices[t[1]] == mesh.vertices[mesh.triangles[i][1]];
        t = {t[1], t[2], t[0]};
      }
      EXPECT_TRUE(is_same) << i;
    }
    EXPECT_EQ(repair(repaired.mesh).done, Lines{});
  }
}

TEST(mesh_repair, leaves_a_band_with_one_side) {
  const TriangleMesh band{{{4, 0, -1}, {4, 0, 1}, {-2, 3, -1}, {-2, 3, 1}, {-2, -3, -1}, {-2, -3, 1}},
                          {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}, {4, 1, 5}, {5, 1, 0}}};
  const Repaired repaired = repair(band);
  EXPECT_EQ(repaired.done, Lines{"left the part of face 0 as it is: it has only one side"});
  EXPECT_EQ(repaired.mesh.triangles, band.triangles);
  EXPECT_NE(words(repaired.mesh), "");
}

}  // namespace
}  // namespace forceshade::mesh
