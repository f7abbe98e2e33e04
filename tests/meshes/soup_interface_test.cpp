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
#include "reference/soups/force.h"
#include "reference/soups/god_object.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/soup_paths.h"
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

}  // namespace
}  // namespace forceshade::reference::soups
