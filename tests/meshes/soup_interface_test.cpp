// SPDX-License-Identifier: BSD-3-Clause
// The public god-objects of both sides on sets of triangles that are not regular are that of reference/soups/, which
// soup_golden_test holds to the stored paths, tick by tick from the state that the one before gave.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <variant>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "reference/position.h"
#include "reference/soups/god_object.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/soup_paths.h"
#include "tests/meshes/uncut.h"
#include "tests/support/drawn.h"

namespace forceshade::reference::soups {
namespace {

constexpr float kStiffness = 0.3F;  // N/mm

std::array<float, 3> rounded(const std::array<meshes::RootSum, 3>& force) {
  return {meshes::nearest_binary32(force[0]), meshes::nearest_binary32(force[1]), meshes::nearest_binary32(force[2])};
}

TEST(soups, every_tick_is_that_of_the_public_interface) {
  std::size_t paths = 0, touching = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/tests/golden/soups")) {
    const tests::SoupPath path = tests::read_soup_path(entry.path());
    if (std::ranges::count(path.sides, path.sides.front()) != std::ssize(path.sides)) continue;  // sides of each triangle
    const auto checked = mesh::check_any(path.mesh);
    ASSERT_TRUE(std::holds_alternative<mesh::CheckedMesh>(checked)) << entry.path();
    MeshRendering rendering{
        std::get<mesh::CheckedMesh>(checked), path.normals, path.sides.front(), mesh::Shading::none, kStiffness, {}};
    EXPECT_FALSE(rendering.checked.is_regular()) << entry.path();
    EXPECT_EQ(mesh::corner_normals(rendering.checked).normals, path.normals) << entry.path();
    const auto plain = tests::built(GodObject::build(rendering));
    const auto in_real_time = tests::built(fast::GodObject::build(rendering));
    rendering.shading = mesh::Shading::vertex_scheme;
    const auto shaded = tests::built(GodObject::build(rendering));
    const auto session = in_real_time.open(), shaded_session = tests::built(fast::GodObject::build(rendering)).open();
    const Soup soup(path.mesh, path.sides);
    State state;
    mesh::GodObject object;
    for (std::size_t i = 0; i < tests::drawn(path.ticks.size()); ++i) {
      const std::array<float, 3> position = tests::position_of(path.ticks[i]);
      const mesh::Tick tick = plain.step(object, position), turned = shaded.step(object, position);
      ASSERT_TRUE(tests::is_same(session->tick(position), tick)) << entry.path().filename() << ", tick " << i + 1;
      ASSERT_TRUE(tests::is_same(shaded_session->tick(position), turned)) << entry.path().filename() << ", tick " << i + 1;
      if (i % 16 == 0) {
        ASSERT_TRUE(tests::is_same(in_real_time.tick(object, position), tick)) << entry.path().filename() << ", tick " << i + 1;
      }
      if (!in_domain(Eigen::Vector3f(position.data()))) {
        ASSERT_EQ(tick.status, Status::invalid);
        ASSERT_EQ(tick.after, object);
        continue;
      }
      const Tick expected = soups::tick(soup, state, position);
      state = expected.after;
      object = object_of(state);
      object.is_slipping = false;  // without friction
      ASSERT_EQ(tick.after, object) << entry.path().filename() << ", tick " << i + 1;
      ASSERT_EQ(turned.after, object);
      ASSERT_EQ(state_of(object).place, state.place);
      ASSERT_EQ(state_of(object).cell, object.place == mesh::Place::free ? Star::Name{} : state.cell);
      ASSERT_EQ(tick.status, expected.status);
      ASSERT_EQ(tick.moves, expected.moves);
      if (!expected.rest) continue;
      ++touching;
      ASSERT_EQ(tick.force, rounded(exact_force(*expected.rest, kStiffness)));
      ASSERT_EQ(turned.force, rounded(exact_force(*expected.rest, kStiffness, path.normals)));
    }
    ++paths;
  }
  EXPECT_GT(paths, 20U);
  EXPECT_GT(touching, 400U);
}

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
}  // namespace forceshade::reference::soups
