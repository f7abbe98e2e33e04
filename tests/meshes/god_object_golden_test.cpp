// SPDX-License-Identifier: BSD-3-Clause
// The reference god-object against paths that other programs have computed.

#include "tests/meshes/reference_paths.h"

namespace forceshade {
namespace {

void expect_same_as_all_in(const std::string& folder) {
  tests::Reached reached;
  for (const std::string& name : tests::god_object_paths_in(folder))
    tests::expect_same(tests::read_god_object_path(folder, name), reached);
  reached.expect_all({"free", "touching", "unfinished", "invalid", "shading turns the force"});
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
