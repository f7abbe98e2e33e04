// SPDX-License-Identifier: BSD-3-Clause
// The real-time side on any set of triangles, against the paths of a program that shares nothing with it, and on meshes against
// those of the programs of meshes.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/soup_words.h"
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

}  // namespace
}  // namespace forceshade::fast::soups
