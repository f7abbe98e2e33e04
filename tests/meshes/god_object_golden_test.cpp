// SPDX-License-Identifier: BSD-3-Clause
// Both sides of the god-object, by every contact rule, against paths that other programs have computed; and with friction of
// coefficient 0 against those of the frictionless one.

#include <cstdlib>

#include "files/csv.h"
#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using tests::GodObjectPath;
using tests::Occasions;

const std::string kGolden = FORCESHADE_SOURCE_DIR "/tests/golden/";

// So many digits that rounding them once more, as the standard library does, is rounding the exact force.
void expect_decimals_of(const mesh::Tick& tick, const reference::DecimalMapForce& decimals, const std::string& place) {
  const std::array<std::string, 3> texts{decimals.x, decimals.y, decimals.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_EQ(std::strtof(texts[axis].c_str(), nullptr), tick.force[axis]) << place << ": " << texts[axis];
}

// Every column of every tick, unshaded and shaded.
void expect_path(const GodObjectPath& path, mesh::Contact contact, Occasions& reached) {
  MeshRendering rendering = tests::shaded(path.mesh, path.normals, path.sides, path.stiffness);
  rendering.contact = contact;
  rendering.materials = path.materials;
  for (const mesh::Shading shading : {mesh::Shading::none, mesh::Shading::vertex_scheme}) {
    rendering.shading = shading;
    tests::BothSides both(rendering);
    for (const tests::PathTick& row : path.ticks) {
      mesh::Tick expected = row.tick;
      if (shading != mesh::Shading::none) expected.force = row.shaded;
      const mesh::Tick tick = both.step(row.position, row.place);
      EXPECT_TRUE(tests::is_same(tick, expected))
          << row.place << ": " << tests::show(tick) << ", expected " << tests::show(expected);
      if (reached["ticks"] % 8 == 0) expect_decimals_of(tick, both.definition().decimal(400), row.place);
      if (testing::Test::HasFailure()) return;
      reached.note(tick);
      reached["shading turns the force"] += expected.force != row.tick.force;
    }
  }
}

// meshes: their folder, where the paths have materials.
Occasions all_in(const std::string& folder, mesh::Contact contact, const std::string& meshes = "") {
  Occasions reached;
  for (const std::string& name : meshes.empty() ? tests::god_object_paths_in(folder) : tests::friction_paths_in(folder))
    expect_path(meshes.empty() ? tests::read_god_object_path(folder, name) : tests::read_friction_path(meshes, folder, name),
                contact, reached);
  reached.expect_all(tests::kEverywhere);
  reached.expect_all({"invalid", "shading turns the force"});
  return reached;
}

TEST(god_object_golden, both_sides_meet_every_column_of_the_paths_of_the_python_programs) {
  all_in(kGolden + "god_object", mesh::Contact::direct).expect_all({"unfinished"});
  all_in(kGolden + "sub_goal_god_object", mesh::Contact::sub_goal);
  all_in(kGolden + "friction", mesh::Contact::friction, kGolden + "god_object").expect_all({"unfinished", "slipping"});
}

TEST(god_object_golden, corner_normals_are_those_of_the_python_program) {
  const std::string folder = kGolden + "god_object", list = folder + "/meshes.csv";
  std::ifstream in = files::open_input(list);
  files::Reader rows(in, list, {"name", "crease_degrees"});
  while (rows.next()) {
    const GodObjectPath path = tests::read_god_object_path(folder, rows.text(0));
    EXPECT_EQ(mesh::corner_normals(tests::checked(path.mesh), static_cast<double>(rows.binary32(1))).normals, path.normals)
        << rows.text(0);
  }
}

TEST(god_object_golden, both_sides_meet_every_column_of_the_paths_in_given_folders) {
  const char *const meshes = std::getenv("FORCESHADE_GOD_OBJECT_PATHS"), *const rough =
                                                                             std::getenv("FORCESHADE_FRICTION_PATHS");
  if (meshes == nullptr) GTEST_SKIP() << "FORCESHADE_GOD_OBJECT_PATHS names no folder of paths";
  all_in(meshes, mesh::Contact::direct);
  if (rough != nullptr) all_in(rough, mesh::Contact::friction, meshes).expect_all({"slipping"});
}

TEST(god_object_golden, with_coefficients_of_0_the_paths_are_those_of_the_frictionless_god_object) {
  const std::string folder = kGolden + "god_object";
  Occasions reached;
  for (const std::string& name : tests::god_object_paths_in(folder)) {
    GodObjectPath path = tests::read_god_object_path(folder, name);
    path.materials.list = {{.stiffness = path.stiffness}};
    path.stiffness = 1;  // is not used: the material has its own
    expect_path(path, mesh::Contact::friction, reached);
  }
  reached.expect_all({"unfinished", "shading turns the force"});
}

}  // namespace
}  // namespace forceshade
