// SPDX-License-Identifier: BSD-3-Clause
// The reference god-object with friction against paths that other programs have computed, and without friction against those
// of the frictionless one.

#include "tests/meshes/reference_paths.h"

namespace forceshade {
namespace {

const std::string kGolden = FORCESHADE_SOURCE_DIR "/tests/golden/";

tests::Reached all_in(const std::string& meshes, const std::string& folder) {
  tests::Reached reached;
  for (const std::string& name : tests::friction_paths_in(folder))
    tests::expect_same(tests::read_friction_path(meshes, folder, name), reached);
  return reached;
}

TEST(friction_golden, the_reference_meets_every_column_of_the_paths_of_the_python_program) {
  all_in(kGolden + "god_object", kGolden + "friction")
      .expect_all({"free", "touching", "unfinished", "invalid", "slipping", "shading turns the force"});
}

TEST(friction_golden, the_reference_meets_every_column_of_the_paths_in_a_given_folder) {
  const char *const meshes = std::getenv("FORCESHADE_GOD_OBJECT_PATHS"), *const folder =
                                                                             std::getenv("FORCESHADE_FRICTION_PATHS");
  if (meshes == nullptr || folder == nullptr)
    GTEST_SKIP() << "FORCESHADE_FRICTION_PATHS names no folder of paths, or "
                    "FORCESHADE_GOD_OBJECT_PATHS none of their meshes";
  all_in(meshes, folder).expect_all({"free", "touching", "invalid", "slipping", "shading turns the force"});
}

TEST(friction_golden, with_coefficients_of_0_the_paths_are_those_of_the_frictionless_god_object) {
  const std::string folder = kGolden + "god_object";
  tests::Reached reached;
  for (const std::string& name : tests::god_object_paths_in(folder)) {
    tests::GodObjectPath path = tests::read_god_object_path(folder, name);
    path.materials.list = {{.stiffness = path.stiffness}};
    path.stiffness = 1;  // is not used: the material has its own
    tests::expect_same(path, reached);
  }
  reached.expect_all({"unfinished", "shading turns the force"});
}

}  // namespace
}  // namespace forceshade
