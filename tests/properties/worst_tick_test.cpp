// SPDX-License-Identifier: BSD-3-Clause
// The search for the tick that looks at the most triangles, on meshes of which it is known.

#include "properties/worst_tick.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "rendering/meshes/make.h"
#include "tests/meshes/costly_meshes.h"
#include "tests/meshes/rendering.h"

namespace forceshade::properties {
namespace {

constexpr int kMostLooks = 16384;

WorstTick found_on(const tests::CostlyMesh& one) {
  const WorstTick worst = worst_tick(tests::unshaded(one.mesh, one.sides));
  std::printf("  %s, %zu triangles: %s\n", one.family, one.mesh.triangles.size(), words_of(worst).c_str());
  return worst;
}

TEST(worst_tick, is_short_on_an_ordinary_mesh) {
  const WorstTick worst = found_on({"sphere", mesh::icosphere(10, 5), mesh::Sides::front, {}});
  EXPECT_GT(worst.looks, 0);
  EXPECT_LT(worst.looks, 400);
  EXPECT_FALSE(worst.is_unfinished);
}

TEST(worst_tick, is_unfinished_among_needles_and_in_a_valley_of_fans) {
  for (const tests::CostlyMesh& one : {tests::needles(30), tests::needles(30, {1, 0.5, 0.25}), tests::valley(257, 36)}) {
    const WorstTick worst = found_on(one);
    EXPECT_TRUE(worst.is_unfinished);
    EXPECT_GE(worst.looks, kMostLooks);
  }
}

// The flight that lands at the vertex looks at all triangles, and so does the tick there.
TEST(worst_tick, is_at_the_vertex_of_most_triangles) {
  const WorstTick worst = found_on(tests::pole(1000, 5));
  EXPECT_GE(worst.looks, 2000);
  EXPECT_FALSE(worst.is_unfinished);
}

TEST(worst_tick, is_the_same_for_the_same_mesh) {
  const auto rendering = tests::unshaded(tests::layers(50, mesh::Sides::both).mesh, mesh::Sides::both);
  EXPECT_EQ(words_of(worst_tick(rendering)), words_of(worst_tick(rendering)));
}

}  // namespace
}  // namespace forceshade::properties
