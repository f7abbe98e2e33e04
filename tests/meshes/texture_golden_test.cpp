// SPDX-License-Identifier: BSD-3-Clause
// The texture scheme on both sides against tests/golden/textured_god_object/, which an independent program makes: the corners
// of each mesh, and every column of every tick.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <variant>

#include "files/csv.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "rendering/meshes/texture.h"
#include "tests/height_maps/height_maps_file.h"
#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

const std::string kFolder = std::string(FORCESHADE_SOURCE_DIR "/tests/golden/textured_god_object");

struct Corners {
  std::vector<std::array<mesh::TexturePoint, 3>> points;  // in the file's unit
  mesh::CornerTextures textures;
};

Corners read_corners(const std::string& name) {
  const std::string path = kFolder + "/" + name + ".texture.csv";
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"triangle", "corner", "u", "v", "x_mm", "y_mm", "xx", "xy", "xz", "yx", "yy", "yz"});
  Corners corners;
  for (std::size_t i = 0; rows.next(); ++i) {
    if (rows.text(0) != std::to_string(i / 3) || rows.text(1) != std::to_string(i % 3))
      throw rows.unexpected(0, "the corners in order");
    if (i % 3 == 0) {
      corners.points.emplace_back();
      corners.textures.emplace_back();
    }
    corners.points.back()[i % 3] = {rows.binary32(2), rows.binary32(3)};
    corners.textures.back()[i % 3] = {{rows.binary32(4), rows.binary32(5)},
                                      {rows.binary32(6), rows.binary32(7), rows.binary32(8)},
                                      {rows.binary32(9), rows.binary32(10), rows.binary32(11)}};
  }
  return corners;
}

struct Options {
  double crease_degrees;
  float scale;  // mm for a unit of the points
};

std::map<std::string, Options> read_options() {
  const std::string path = kFolder + "/meshes.csv";
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"name", "crease_degrees", "scale_mm"});
  std::map<std::string, Options> options;
  while (rows.next()) options[rows.text(0)] = {static_cast<double>(rows.binary32(1)), rows.binary32(2)};
  return options;
}

TEST(texture_golden, corners_and_ticks_are_those_of_the_python_program_on_both_sides) {
  const auto maps = tests::height_maps_in(kFolder + "/maps.csv");
  tests::Occasions reached;
  for (const auto& [name, options] : read_options()) {
    const tests::GodObjectPath path = tests::read_god_object_path(kFolder, name);
    const Corners corners = read_corners(name);
    const auto checked = std::get<mesh::CheckedMesh>(mesh::check(path.mesh));
    std::vector<std::array<mesh::TexturePoint, 3>> in_mm = corners.points;
    for (auto& points : in_mm)
      for (mesh::TexturePoint& point : points)
        for (float& number : point) {
          // A product of two binary32 numbers is exact in binary64.
          number = static_cast<float>(static_cast<double>(number) * static_cast<double>(options.scale));
          if (std::fabs(number) < 0x1p-30F) number = 0;
        }
    ASSERT_EQ(mesh::corner_textures(checked, in_mm, options.crease_degrees), corners.textures) << name;

    constexpr auto kScheme = mesh::Shading::texture_scheme;
    const MeshRendering rendering{checked, path.normals,   path.sides,
                                  kScheme, path.stiffness, {corners.textures, maps.at(name)}};
    tests::BothSides both(rendering);
    for (const tests::PathTick& row : path.ticks) {
      mesh::Tick expected = row.tick;
      expected.force = row.shaded;
      const mesh::Tick tick = both.step(row.position, row.place);
      ASSERT_TRUE(tests::is_same(tick, expected))
          << row.place << ": " << tests::show(tick) << ", expected " << tests::show(expected);
      reached.note(tick);
      if (tick.status == Status::contact) ++reached[row.shaded == row.tick.force ? "unshaded" : "turned"];
    }
    ++reached["meshes"];
  }
  reached.expect_all(tests::kEverywhere);
  reached.expect_all({"meshes", "invalid", "unshaded", "turned"});
  EXPECT_EQ(reached["meshes"], maps.size());
}

}  // namespace
}  // namespace forceshade
