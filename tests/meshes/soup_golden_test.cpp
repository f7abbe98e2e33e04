// SPDX-License-Identifier: BSD-3-Clause
// The god-object of both sides on any set of triangles, against the paths of a program that shares nothing with them
// (tests/golden/make_soup_golden.py), and on meshes against those of the programs of meshes.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/soup_both_sides.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade::tests {
namespace {

constexpr float kStiffness = 0.3F;  // of every path, N/mm
const std::string kGolden = FORCESHADE_SOURCE_DIR "/tests/golden/";

// The exact side goes the first ticks of a path.
template <class Side>
class soups : public testing::Test {
 protected:
  static std::size_t some_of(std::size_t ticks) { return std::is_same_v<Side, ExactSoup> ? drawn(ticks) : ticks; }

  static void expect_same(const GodObjectPath& path) {
    std::vector<mesh::Material> materials;
    for (const std::uint32_t i : path.materials.of_triangle) materials.push_back(path.materials.list[i]);
    Side side(path.mesh, {path.sides}, materials, path.normals, kStiffness);
    for (std::size_t i = 0; i < some_of(path.ticks.size()); ++i) {
      const PathTick& row = path.ticks[i];
      const SoupTick made = side.tick(row.position);
      ASSERT_EQ(made.status, row.tick.status) << row.place;
      if (made.status == Status::invalid) continue;
      ASSERT_EQ(made.moves, row.tick.moves) << row.place;
      ASSERT_EQ(made.is_free() ? "-" : made.place, feature_text(row.tick.after)) << row.place;
      ASSERT_EQ(!made.is_free() && std::get<1>(made.cell), row.tick.after.side == mesh::Side::back) << row.place;
      ASSERT_EQ(!materials.empty() && made.is_slipping, row.tick.after.is_slipping) << row.place;
      ASSERT_EQ(made.force, row.tick.force) << row.place;
      ASSERT_EQ(made.shaded, row.shaded) << row.place;
    }
  }
};
using Sides = testing::Types<ExactSoup, FastSoup>;
TYPED_TEST_SUITE(soups, Sides);

TYPED_TEST(soups, every_column_is_that_of_another_program) {
  std::map<std::string, std::size_t> places;
  for (const auto& entry : std::filesystem::directory_iterator(kGolden + "soups")) {
    const SoupPath path = read_soup_path(entry.path());
    TypeParam side(path.mesh, path.sides, {}, path.normals, kStiffness);
    for (std::size_t i = 0; i < this->some_of(path.ticks.size()); ++i) {
      const Position position = position_of(path.ticks[i]);
      const SoupTick made = side.tick(position);
      const bool is_touching = made.status != Status::invalid && !made.is_free();
      ASSERT_EQ(words(position) + ',' + made.line(is_touching ? side.lowest() : 0), path.ticks[i])
          << entry.path().filename() << ", tick " << i + 1;
      ++places[is_touching ? made.place.substr(0, made.place.find(' ')) : "-"];
    }
  }
  for (const char* const place : {"-", "v", "e", "t", "c", "ee", "ef", "fff", "q"}) {
    std::printf("  %7zu %s\n", places[place], place);
    EXPECT_GT(places[place], 0U) << place;
  }
}

TYPED_TEST(soups, a_mesh_is_a_soup_with_the_same_paths) {
  const std::string meshes = kGolden + "god_object", rough = kGolden + "friction";
  for (const std::string& name : god_object_paths_in(meshes)) this->expect_same(read_god_object_path(meshes, name));
  for (const std::string& name : friction_paths_in(rough)) this->expect_same(read_friction_path(meshes, rough, name));
}

TEST(soups_in_real_time, a_tick_allocates_nothing) {
  std::size_t ticks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kGolden + "soups")) {
    const SoupPath path = read_soup_path(entry.path());
    FastSoup side(path.mesh, path.sides, {}, path.normals, kStiffness);
    std::size_t allocated = 0;
    for (const std::string& line : path.ticks) {
      const Position position = position_of(line);
      const std::size_t before = allocations();
      side.shaded.tick(position);
      allocated += allocations() - before;
    }
    EXPECT_EQ(allocated, 0U) << entry.path().filename();
    ticks += path.ticks.size();
  }
  EXPECT_GT(ticks, 5000U);
}

// Far beyond the domain of a mesh, where no proof holds: a tick whose integers are cut is unfinished and keeps the state, and
// the test in which it happens fails.
TEST(soups_in_real_time, a_tick_whose_integers_are_cut_is_unfinished) {
  constexpr float kFar = 0x1p65F;
  FastSoup side({{{0, 0, 0},
                  {kFar * 1.34375F, kFar * -0.1875F, kFar * 1.359375F},
                  {kFar * -1.28125F, kFar * -0.421875F, kFar * -0.015625F},
                  {kFar * 1.140625F, kFar * 0.15625F, kFar * -0.859375F},
                  {kFar * -0.5625F, kFar * -0.703125F, kFar * 1.328125F}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}},
                {mesh::Sides::both}, {}, mesh::CornerNormals(3, {mesh::Normal{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}), kStiffness);
  fast::soups::Session& session = side.shaded;
  for (const Position& position : {Position{-1.390625F, -1.125F, 1.0625F}, {-0.15625F, -0.046875F, -0.5625F}})
    EXPECT_NE(session.tick(position).status, Status::unfinished);
  EXPECT_EQ(session.tick({0.78125F, 1.25F, -0.046875F}).status, Status::contact);
  const fast::soups::State before = session.state();
  expect_uncut();
  const fast::soups::Tick tick = session.tick({-0.484375F, 0.640625F, 1.375F});
  EXPECT_NONFATAL_FAILURE(expect_uncut(), "longer than soup_bits_test allows");
  fast::soups::Whole::cuts = 0;
  EXPECT_EQ(tick.status, Status::unfinished);
  EXPECT_EQ(tick.moves, 0U);
  EXPECT_EQ(tick.force, Position{});
  EXPECT_TRUE(tick.after == before && session.state() == before);
}

}  // namespace
}  // namespace forceshade::tests
