// SPDX-License-Identifier: BSD-3-Clause
// The random meshes are such as a god-object may be on, and hard; the random paths reach what they are made for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "forceshade/meshes.h"
#include "properties/mesh_path.h"
#include "tests/support/mesh_source.h"

namespace forceshade {
namespace {

using properties::kPathKinds;
using properties::MeshPath;
using tests::kMeshFamilies;
using tests::MeshSource;
using tests::RandomMesh;

TEST(random_meshes, every_one_is_a_mesh_and_each_family_has_what_it_is_for) {
  MeshSource source(11);
  std::map<std::string, int> found;
  std::size_t triangles = 0;
  constexpr int kMeshes = 1650;
  for (int i = 0; i < kMeshes; ++i) {
    const RandomMesh made = source.next();
    const std::string family(kMeshFamilies[made.family]);
    const auto checked = mesh::check(made.mesh);
    if (const auto* findings = std::get_if<mesh::Findings>(&checked))
      FAIL() << i << ", " << family << ": " << findings->words();
    triangles += made.mesh.triangles.size();
    ++found[family];
    ++found[made.sides == mesh::Sides::both ? "both sides" : "front"];
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_at;
    for (const auto& [a, b, c] : made.mesh.triangles)
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++triangles_at[std::minmax(from, to)];
    const bool is_closed = std::ranges::all_of(triangles_at, [](const auto& edge) { return edge.second == 2; });
    EXPECT_EQ(is_closed, family == "bipyramid" || family == "slab" || family == "star" || family == "torus") << family;
    std::map<std::uint32_t, int> valence;
    for (const mesh::Triangle& triangle : made.mesh.triangles)
      for (const std::uint32_t v : triangle) ++valence[v];
    found["a vertex with 3 triangles"] += std::ranges::any_of(valence, [](const auto& v) { return v.second == 3; });
    found["a vertex with 100 triangles or more"] += std::ranges::any_of(valence, [](const auto& v) { return v.second >= 100; });
    float farthest = 0;
    for (const mesh::Vertex& vertex : made.mesh.vertices)
      for (const float x : vertex) farthest = std::max(farthest, std::fabs(x));
    found["smaller than 0.1 mm"] += farthest < 0.1F;
    found["larger than 1000 mm"] += farthest > 1000;
  }
  std::printf("  %d meshes, %zu triangles\n", kMeshes, triangles);
  for (const auto& [what, times] : found) {
    std::printf("  %5d %s\n", times, what.c_str());
    EXPECT_GT(times, 0) << what;
  }
  EXPECT_EQ(found.size(), kMeshFamilies.size() + 6);
}

TEST(random_meshes, each_stream_repeats_itself) {
  MeshSource one(5), other(5), different(6);
  bool differs = false;
  for (int i = 0; i < 22; ++i) {
    const RandomMesh a = one.next(), b = other.next(), c = different.next();
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(one.normals_of(a.mesh), other.normals_of(b.mesh));
    differs |= a.mesh.vertices != c.mesh.vertices;
    MeshPath path(a.mesh, 3), again(b.mesh, 3);
    for (int k = 0; k < 100; ++k) {
      const auto p = path.next(), q = again.next();
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_TRUE(p[axis] == q[axis] || std::isnan(p[axis])) << k;
    }
  }
  EXPECT_TRUE(differs);
}

TEST(random_meshes, paths_have_every_kind_of_stretch_and_steps_of_every_size) {
  MeshSource source(7);
  std::map<std::string, int> kinds;
  std::map<int, int> steps;  // by their decimal exponent
  for (int i = 0; i < 110; ++i) {
    MeshPath path(source.next().mesh, static_cast<std::uint64_t>(i));
    std::array<float, 3> last{};
    for (int k = 0; k < 300; ++k) {
      const std::array<float, 3> position = path.next();
      ++kinds[std::string(kPathKinds[static_cast<std::size_t>(path.kind())])];
      const float step = std::hypot(position[0] - last[0], position[1] - last[1], position[2] - last[2]);
      if (step == 0) ++kinds["repeated"];
      if (step > 0 && std::isfinite(step)) ++steps[static_cast<int>(std::floor(std::log10(step)))];
      last = position;
    }
  }
  for (const auto& [kind, times] : kinds) std::printf("  %6d %s\n", times, kind.c_str());
  for (const auto& [exponent, times] : steps) std::printf("  %6d steps of 1e%d mm\n", times, exponent);
  EXPECT_EQ(kinds.size(), kPathKinds.size() + 1);
  for (int exponent = -9; exponent <= 3; ++exponent) EXPECT_GT(steps[exponent], 0) << "1e" << exponent << " mm";
}

}  // namespace
}  // namespace forceshade
