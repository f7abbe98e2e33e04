// SPDX-License-Identifier: BSD-3-Clause
// The real-time god-object against paths that other programs have computed.

#include "forceshade/fast/meshes/god_object.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "forceshade/tests/meshes/god_object_paths.h"

namespace forceshade::fast {
namespace {

Mesh built(const tests::GodObjectPath& path) {
  auto mesh = Mesh::build(path.mesh, path.normals, path.sides);
  if (const auto* message = std::get_if<std::string>(&mesh)) throw std::runtime_error(path.name + ": " + *message);
  return std::get<Mesh>(std::move(mesh));
}

template <class Stages>
int differences(const tests::GodObjectPath& path, const Stages& stages) {
  const Mesh mesh = built(path);
  mesh::GodObject plain, shaded;
  int found = 0;
  for (const tests::PathTick& row : path.ticks) {
    const mesh::Tick tick = step(mesh, plain, row.position, path.stiffness, mesh::Shading::none, stages);
    const mesh::Tick other = step(mesh, shaded, row.position, path.stiffness, mesh::Shading::vertex_scheme, stages);
    plain = tick.after;
    shaded = other.after;
    mesh::Tick expected_shaded = row.tick;
    expected_shaded.force = row.shaded;
    if (tests::is_same(tick, row.tick) && tests::is_same(other, expected_shaded)) continue;
    if (++found <= 3)
      ADD_FAILURE() << row.place << "\n  expected " << tests::show(row.tick) << "\n  found    " << tests::show(tick)
                    << "\n  expected shaded " << tests::show(expected_shaded) << "\n  found    " << tests::show(other);
    plain = shaded = row.tick.after;
  }
  return found;
}

// The folder is not part of this project: where the variable is not set, there is nothing to compare with.
TEST(god_object, equals_the_paths_of_an_independent_program_in_every_column) {
  const char* folder = std::getenv("FORCESHADE_GOD_OBJECT_PATHS");
  if (folder == nullptr) GTEST_SKIP() << "FORCESHADE_GOD_OBJECT_PATHS is not set";
  std::size_t ticks = 0;
  const auto names = tests::god_object_paths_in(folder);
  for (const std::string& name : names) {
    const tests::GodObjectPath path = tests::read_god_object_path(folder, name);
    ticks += path.ticks.size();
    EXPECT_EQ(differences(path, ExactStages()), 0) << name << ", in integers";
    EXPECT_EQ(differences(path, FilteredStages()), 0) << name << ", in binary64 first";
  }
  std::printf("%zu paths, %zu ticks, each with and without a filter\n", names.size(), ticks);
  EXPECT_GT(ticks, 0U);
}

}  // namespace
}  // namespace forceshade::fast
