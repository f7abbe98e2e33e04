// SPDX-License-Identifier: BSD-3-Clause
// The real-time side on any set of triangles, against the paths of a program that shares nothing with it, and on meshes against
// those of the programs of meshes.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/soup_words.h"
#include "tests/meshes/uncut.h"
#include "tests/support/allocations.h"

namespace forceshade::fast::soups {
namespace {

constexpr float kStiffness = 0.3F;  // of every path, N/mm

TEST(soups_in_real_time, every_column_is_that_of_another_program) {
  std::size_t paths = 0, ticks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/tests/golden/soups")) {
    const tests::SoupPath path = tests::read_soup_path(entry.path());
    const auto soup = std::make_shared<const Soup>(path.mesh, path.sides, std::vector<mesh::Material>{}, path.normals);
    Session plain(soup, kStiffness, false), shaded(soup, kStiffness, !path.normals.empty());
    for (const std::string& line : path.ticks) {
      ASSERT_EQ(tests::line_of_tick(*soup, plain, shaded, tests::position_of(line)), line)
          << entry.path().filename() << ", tick " << &line - path.ticks.data() + 1;
      ++ticks;
    }
    ++paths;
    Session again(soup, kStiffness, !path.normals.empty());
    std::size_t allocated = 0;
    for (const std::string& line : path.ticks) {
      const std::array<float, 3> position = tests::position_of(line);
      const std::size_t before = tests::allocations();
      again.tick(position);
      allocated += tests::allocations() - before;
    }
    EXPECT_EQ(allocated, 0U) << entry.path().filename();
  }
  std::printf("  %zu paths, %zu ticks\n", paths, ticks);
  EXPECT_GT(ticks, 5000U);
}

void expect_same(const tests::GodObjectPath& path) {
  std::vector<mesh::Material> materials;
  for (const std::uint32_t i : path.materials.of_triangle) materials.push_back(path.materials.list[i]);
  const auto soup = std::make_shared<const Soup>(path.mesh, std::vector{path.sides}, materials, path.normals);
  Session plain(soup, kStiffness, false), shaded(soup, kStiffness, true);
  for (const tests::PathTick& row : path.ticks) {
    const Tick made = plain.tick(row.position), other = shaded.tick(row.position);
    ASSERT_EQ(made.status, row.tick.status) << row.place;
    if (made.status == Status::invalid) continue;
    const bool is_off = made.after.place.kind == PlaceKind::free;
    ASSERT_EQ(made.moves, row.tick.moves) << row.place;
    ASSERT_EQ(is_off ? "-" : tests::words(made.after.place), tests::feature_text(row.tick.after)) << row.place;
    ASSERT_EQ(!is_off && made.after.cell.is_behind, row.tick.after.side == mesh::Side::back) << row.place;
    ASSERT_EQ(!materials.empty() && made.after.is_slipping, row.tick.after.is_slipping) << row.place;
    ASSERT_EQ(made.force, row.tick.force) << row.place;
    ASSERT_EQ(other.force, row.shaded) << row.place;
    ASSERT_TRUE(made.after == other.after) << row.place;
  }
}

TEST(soups_in_real_time, a_mesh_has_the_same_paths) {
  const std::string meshes = FORCESHADE_SOURCE_DIR "/tests/golden/god_object",
                    rough = FORCESHADE_SOURCE_DIR "/tests/golden/friction";
  for (const std::string& name : tests::god_object_paths_in(meshes)) expect_same(tests::read_god_object_path(meshes, name));
  for (const std::string& name : tests::friction_paths_in(rough)) expect_same(tests::read_friction_path(meshes, rough, name));
}

// Far beyond the domain of a mesh, where no proof holds: a tick whose integers are cut is unfinished and keeps the state, and
// the test in which it happens fails.
TEST(soups_in_real_time, a_tick_whose_integers_are_cut_is_unfinished) {
  constexpr float kFar = 0x1p65F;
  const mesh::TriangleMesh mesh{{{0, 0, 0},
                                 {kFar * 1.34375F, kFar * -0.1875F, kFar * 1.359375F},
                                 {kFar * -1.28125F, kFar * -0.421875F, kFar * -0.015625F},
                                 {kFar * 1.140625F, kFar * 0.15625F, kFar * -0.859375F},
                                 {kFar * -0.5625F, kFar * -0.703125F, kFar * 1.328125F}},
                                {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};
  const auto soup = std::make_shared<const Soup>(
      mesh, std::vector{mesh::Sides::both}, std::vector<mesh::Material>{},
      mesh::CornerNormals(3, {mesh::Normal{0, 0, 1}, mesh::Normal{0, 1, 0}, mesh::Normal{1, 0, 0}}));
  Session session(soup, kStiffness, true);
  for (const std::array<float, 3>& position : {std::array{-1.390625F, -1.125F, 1.0625F}, {-0.15625F, -0.046875F, -0.5625F}})
    EXPECT_NE(session.tick(position).status, Status::unfinished);
  EXPECT_EQ(session.tick({0.78125F, 1.25F, -0.046875F}).status, Status::contact);
  const State before = session.state();
  tests::expect_uncut();
  const Tick tick = session.tick({-0.484375F, 0.640625F, 1.375F});
  EXPECT_NONFATAL_FAILURE(tests::expect_uncut(), "longer than soup_bits_test allows");
  Whole::cuts = 0;
  EXPECT_EQ(tick.status, Status::unfinished);
  EXPECT_EQ(tick.moves, 0U);
  EXPECT_EQ(tick.force, (std::array<float, 3>{}));
  EXPECT_TRUE(tick.after == before && session.state() == before);
}

}  // namespace
}  // namespace forceshade::fast::soups
