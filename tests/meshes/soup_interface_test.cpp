// SPDX-License-Identifier: BSD-3-Clause
// The public god-objects of both sides on sets of triangles that are not regular: looks, materials, and states from outside.
// The stored paths go through them in Python (test_soups.py), and crossing_meshes_test compares the sides.

#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/uncut.h"

namespace forceshade::reference {
namespace {

constexpr float kStiffness = 0.3F;  // N/mm

// Along a strip of narrow cells, one of which is there twice, a tick has more triangles to look at than it may. Each triangle's
// material is that of its number in the file.
TEST(soups, a_tick_has_as_many_looks_and_the_stiffness_that_the_definition_gives_it) {
  mesh::TriangleMesh strip;
  for (std::uint32_t i = 0; i <= 400; ++i) {
    for (const float y : {-8.0F, 8.0F}) strip.vertices.push_back({0.25F * static_cast<float>(i), y, 0});
    if (i == 400) continue;
    strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    strip.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  strip.triangles.push_back(strip.triangles.front());
  MeshRendering rendering{
      std::get<mesh::CheckedMesh>(mesh::check_any(strip)), {}, mesh::Sides::both, mesh::Shading::none, kStiffness, {}};
  rendering.materials.list = {{}, {.stiffness = 0.75F}};
  for (std::uint32_t i = 0; i < strip.triangles.size(); ++i) rendering.materials.of_triangle.push_back(i / 2 % 2);
  const auto exact = tests::built(GodObject::build(rendering));
  const auto in_real_time = tests::built(fast::GodObject::build(rendering));
  const auto session = in_real_time.open();
  mesh::GodObject object;
  std::vector<std::uint16_t> moves;
  std::vector<float> forces;
  for (const std::array<float, 3>& position :
       {std::array{1.1F, 1.0F, 2.0F}, {1.1F, 1, -1}, {1.4F, 1, -1}, {90.1F, 1, -1}, {90.1F, 1, -1}, {90.1F, 1, -1}}) {
    const mesh::Tick tick = exact.step(object, position);
    ASSERT_TRUE(tests::is_same(session->tick(position), tick)) << moves.size();
    object = tick.after;
    EXPECT_FALSE(object.is_slipping) << "without friction nothing slips";
    moves.push_back(tick.moves);
    forces.push_back(tick.force[2]);
    EXPECT_EQ(tick.status == Status::unfinished, moves.size() >= 4) << moves.size();
  }
  EXPECT_LT(moves[3], GodObject::kMostMoves);
  EXPECT_GT(moves[3], moves[2]);
  EXPECT_EQ(forces[1], kStiffness);
  EXPECT_EQ(forces[2], 0.75F);
  // From above the strip is met, but not from where no state is.
  const std::array<float, 3> below{1.1F, 1, -1};
  for (const auto& [z, is_state] : {std::pair{10'000.0F, true}, {10'001.0F, false}, {std::nanf(""), false}}) {
    const mesh::GodObject far{.place = mesh::Place::free, .position = {1, 1, z}};
    EXPECT_EQ(in_real_time.tick(far, below).status, is_state ? Status::contact : Status::free) << z;
    EXPECT_TRUE(is_state || tests::is_same(in_real_time.tick(far, below), in_real_time.tick({}, below))) << z;
  }
}

}  // namespace
}  // namespace forceshade::reference
