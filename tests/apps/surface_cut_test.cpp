// SPDX-License-Identifier: BSD-3-Clause
#include "apps/surface_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <variant>

#include "rendering/meshes/make.h"

namespace forceshade::apps {
namespace {

constexpr double kAccuracy = 0.02;  // mm: twice that of the halving

Description bump(LawId law) {
  return {std::string(name_of(law)), DescribedLaw{law, {15.24F, 25.4F, 0.5F}}};
}

window::Section cut_of(const Description& what, double y) {
  return SurfaceCut(what, std::get<Rendering>(rendering_of(what))).at(y);
}

Description mesh_of(mesh::TriangleMesh triangles) {
  auto checked = mesh::check(std::move(triangles));
  return {"mesh", MeshRendering{.checked = std::get<mesh::CheckedMesh>(std::move(checked)), .stiffness = 0.5F}};
}

// The surface of a bump is that of docs/laws.md: on two polygons the height falls in proportion to |x|.
TEST(surface_cut, follows_the_height_of_a_law) {
  const double half = 12.7, d = std::sqrt(15.24 * 15.24 - half * half), h = 15.24 - d;
  int on_bump = 0;
  const window::Section two = cut_of(bump(LawId::bump_2p), 3);
  for (const window::Column& column : two.columns) {
    ASSERT_EQ(column.inside.size(), 1U) << column.x;
    const double expected = std::max(0.0, h * (1 - std::fabs(column.x) / half));
    EXPECT_NEAR(column.inside[0].high, expected, kAccuracy) << column.x;
    on_bump += expected > 0;
  }
  std::printf("%zu columns, %d of them on the bump\n", two.columns.size(), on_bump);
  EXPECT_GT(on_bump, 100);
  const window::Section flat = cut_of(bump(LawId::bump_1p_shaded), 0);
  for (const window::Column& column : flat.columns) EXPECT_NEAR(column.inside.at(0).high, 0, kAccuracy);
}

// Forces that are at right angles to a circle let a circle be felt, on one polygon as on two (docs/laws.md).
// The slope jumps by 1.5 between two columns, 0.165 mm from each other, which the sum takes for a line.
TEST(surface_cut, has_the_shape_that_shading_lets_be_felt) {
  const double half = 12.7, d = std::sqrt(15.24 * 15.24 - half * half);
  for (const LawId law : {LawId::bump_1p_shaded, LawId::bump_2p_shaded}) {
    const window::Section section = cut_of(bump(law), -2);
    ASSERT_FALSE(section.felt.empty());
    EXPECT_NEAR(section.felt.front()[0].x, -half, 3);
    EXPECT_NEAR(section.felt.back()[1].x, half, 3);
    for (const auto& [a, b] : section.felt) {
      EXPECT_LT(a.x, b.x);
      if (std::fabs(b.x) < half) {
        EXPECT_NEAR(b.z, std::sqrt(15.24 * 15.24 - b.x * b.x) - d, 0.13) << name_of(law) << ' ' << b.x;
      }
    }
  }
}

TEST(surface_cut, has_no_other_shape_to_feel_without_shading) {
  for (const LawId law : {LawId::bump_2p, LawId::cylinder}) EXPECT_EQ(cut_of(bump(law), 0).felt.size(), 0U) << name_of(law);
}

// A cylinder that lies in the region as a whole has an underside.
TEST(surface_cut, shows_the_underside_of_a_cylinder) {
  const Description cylinder{"cylinder", DescribedLaw{LawId::cylinder, {5, 10, 0.5F}}};
  int closed = 0;
  const window::Section section = cut_of(cylinder, 0);
  for (const window::Column& column : section.columns) {
    if (!(std::fabs(column.x) < 4.9)) continue;
    ASSERT_EQ(column.inside.size(), 1U);
    const double z = std::sqrt(25 - column.x * column.x);
    EXPECT_NEAR(column.inside[0].high, z, kAccuracy + 0.05);
    EXPECT_NEAR(column.inside[0].low,
                std::max(-z, SurfaceCut(cylinder, std::get<Rendering>(rendering_of(cylinder))).region().bottom),
                kAccuracy + 0.05);
    ++closed;
  }
  EXPECT_GT(closed, 50);
}

TEST(surface_cut, cuts_a_mesh_where_the_hand_is) {
  const Description torus = mesh_of(mesh::torus(30, 8, 96, 48));
  // Across the middle two circles, and beyond them nothing.
  const window::Section middle = cut_of(torus, 0);
  int counts[3]{};
  for (const window::Column& column : middle.columns) {
    ASSERT_LE(column.inside.size(), 1U);
    const double off = std::fabs(std::fabs(column.x) - 30);
    EXPECT_EQ(column.inside.size(), off < 7.9 ? 1U : off > 8 ? 0U : column.inside.size()) << column.x;
    if (column.inside.empty() || off > 7.5) continue;
    EXPECT_NEAR(column.inside[0].high, std::sqrt(64 - off * off), 0.2);
    EXPECT_NEAR(column.inside[0].low, -std::sqrt(64 - off * off), 0.2);
    ++counts[0];
  }
  // Near its rim one shape, off the mesh none.
  for (const window::Column& column : cut_of(torus, 37).columns) counts[1] += !column.inside.empty();
  for (const window::Column& column : cut_of(torus, 39).columns) counts[2] += !column.inside.empty();
  std::printf("columns with something inside: %d, %d, %d\n", counts[0], counts[1], counts[2]);
  EXPECT_GT(counts[0], 50);
  EXPECT_GT(counts[1], 50);
  EXPECT_EQ(counts[2], 0);
}

// A surface with a rim has no underside, and what is below it counts as inside. Its own vertices lie in the plane y = 0.
TEST(surface_cut, fills_what_is_below_a_mesh_with_a_rim) {
  const Description cap = mesh_of(mesh::bump(15.24, 25.4, 100, 20));
  const window::Section section = cut_of(cap, 0);
  int high = 0;
  for (const window::Column& column : section.columns) {
    if (!(std::fabs(column.x) < 49.9)) continue;
    ASSERT_EQ(column.inside.size(), 1U) << column.x;
    EXPECT_GE(column.inside[0].high, -1e-6);
    high += column.inside[0].high > 5;
  }
  EXPECT_GT(high, 10);
}

TEST(surface_cut, has_a_place_for_a_god_object_that_touches_and_none_for_a_free_one) {
  const mesh::TriangleMesh cube = mesh::cube(20);
  mesh::GodObject state;
  EXPECT_FALSE(place_on(cube, state));
  state.place = mesh::Place::free;
  EXPECT_FALSE(place_on(cube, state));
  state.place = mesh::Place::vertex;
  state.index = {3, 0};
  const auto at = place_on(cube, state);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->x, static_cast<double>(cube.vertices[3][0]));
  EXPECT_EQ(at->z, static_cast<double>(cube.vertices[3][2]));
}

}  // namespace
}  // namespace forceshade::apps
