// SPDX-License-Identifier: BSD-3-Clause
// The reference god-object against paths that other programs have computed: every column of every tick, unshaded and shaded.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "forceshade/reference.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

using tests::GodObjectPath;
using tests::PathTick;

constexpr unsigned kDigits = 400;

struct Counts {
  int paths = 0, ticks = 0, most_moves = 0;
  std::map<std::string, int> reached;
};

reference::GodObject god_object(const GodObjectPath& path, mesh::Shading shading) {
  MeshRendering rendering = tests::shaded(path.mesh, path.normals, path.sides, path.stiffness);
  rendering.shading = shading;
  return tests::built(reference::GodObject::build(rendering));
}

// So many digits that rounding them once more, as the standard library does, is rounding the exact force.
void expect_decimals_of(const mesh::Tick& tick, const reference::DecimalMapForce& decimals, const std::string& place) {
  const std::array<std::string, 3> texts{decimals.x, decimals.y, decimals.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(std::strtof(texts[axis].c_str(), nullptr), tick.force[axis]) << place << ": " << texts[axis];
}

void expect_same(const GodObjectPath& path, Counts& counts) {
  reference::GodObjectSession session(god_object(path, mesh::Shading::none));
  const reference::GodObject shaded = god_object(path, mesh::Shading::vertex_scheme);
  for (const PathTick& row : path.ticks) {
    mesh::Tick expected_shaded = row.tick;
    expected_shaded.force = row.shaded;
    const mesh::GodObject before = session.state();
    const mesh::Tick with_shading = shaded.step(before, row.position), tick = session.step(row.position);
    if (counts.ticks % 8 == 0) {
      expect_decimals_of(tick, session.decimal(kDigits), row.place);
      expect_decimals_of(with_shading, shaded.decimal(before, row.position, kDigits), row.place);
    }
    ASSERT_TRUE(tests::is_same(tick, row.tick))
        << row.place << ": " << tests::show(tick) << ", expected " << tests::show(row.tick);
    ASSERT_TRUE(tests::is_same(with_shading, expected_shaded))
        << row.place << ": shaded " << tests::show(with_shading) << ", expected " << tests::show(expected_shaded);
    ++counts.ticks;
    counts.most_moves = std::max<int>(counts.most_moves, tick.moves);
    ++counts.reached[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)])];
    if (tick.status == mesh::TickStatus::invalid || tick.status == mesh::TickStatus::free) continue;
    ++counts.reached[std::string(mesh::kPlaceNames[static_cast<std::size_t>(tick.after.place)])];
    ++counts.reached[std::string(mesh::kSideNames[static_cast<std::size_t>(tick.after.side)])];
    counts.reached["shading turns the force"] += tick.force != with_shading.force;
  }
  ++counts.paths;
}

void expect_same_as_all_in(const std::string& folder) {
  Counts counts;
  for (const std::string& name : tests::god_object_paths_in(folder))
    expect_same(tests::read_god_object_path(folder, name), counts);
  std::printf("  %d paths, %d ticks, at most %d moves in one\n", counts.paths, counts.ticks, counts.most_moves);
  for (const char* what : {"free", "touching", "unfinished", "invalid", "vertex", "edge", "triangle", "front", "back",
                           "shading turns the force"}) {
    std::printf("  %7d %s\n", counts.reached[what], what);
    EXPECT_GT(counts.reached[what], 0) << what;
  }
}

TEST(god_object_golden, the_reference_meets_every_column_of_the_paths_of_the_python_program) {
  expect_same_as_all_in(std::string(FORCESHADE_SOURCE_DIR "/tests/golden/god_object"));
}

TEST(god_object_golden, the_reference_meets_every_column_of_the_paths_in_a_given_folder) {
  const char* const folder = std::getenv("FORCESHADE_GOD_OBJECT_PATHS");
  if (folder == nullptr) GTEST_SKIP() << "FORCESHADE_GOD_OBJECT_PATHS names no folder of paths";
  expect_same_as_all_in(folder);
}

}  // namespace
}  // namespace forceshade
