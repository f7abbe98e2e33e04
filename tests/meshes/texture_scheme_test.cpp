// SPDX-License-Identifier: BSD-3-Clause
// A height map that is laid over a mesh turns the force (docs/god-object.md, the texture scheme): on both sides.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "fast/meshes/session.h"
#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/texture.h"
#include "tests/meshes/both_sides.h"
#include "tests/support/any_height_map.h"
#include "tests/support/mesh_source.h"
#include "tests/support/words.h"

namespace forceshade {
namespace {

using Position = std::array<float, 3>;

constexpr float kStiffness = 0.3F;  // N/mm

HeightMap random_map(std::uint64_t seed) {
  return {tests::any_height_map().draw(seed).map.parts};
}

const char* name_of_stage(fast::Stage stage) {
  return stage == fast::Stage::binary64 ? "binary64" : stage == fast::Stage::double_double ? "double-double" : "wide";
}

TEST(texture_scheme, slopes_are_the_reference_s_in_every_bit_on_random_maps_and_with_every_filter) {
  tests::Occasions counts;
  const std::uint64_t maps = tests::drawn(200);
  std::mt19937_64 random(5);
  for (std::uint64_t seed = 0; seed < maps; ++seed) {
    const HeightMap map = random_map(seed);
    const auto fast_map = fast::HeightMapField::build(map, height::Mode::force_shaded, 1);
    const auto reference_map = reference::HeightMapField::build(map, height::Mode::force_shaded, 1);
    ASSERT_TRUE(std::holds_alternative<fast::HeightMapField>(fast_map) &&
                std::holds_alternative<reference::HeightMapField>(reference_map));
    const auto& fast_field = std::get<fast::HeightMapField>(fast_map);
    for (int i = 0; i < 20; ++i) {
      const auto coordinate = [&] {
        const auto whole = static_cast<float>(static_cast<std::int32_t>(random() >> 40) - (1 << 23));
        return i % 3 == 0 ? std::round(whole * 0x1p-19F) / 2 : whole * (i % 3 == 1 ? 0x1p-19F : 0x1p-10F);
      };
      const float x = coordinate(), y = coordinate();
      const auto expected = std::get<reference::HeightMapField>(reference_map).slopes(x, y);
      const auto found = fast_field.slopes(x, y), unfiltered = fast_field.slopes(x, y, false);
      ASSERT_TRUE(found && unfiltered) << seed;
      for (const auto& values : {found->values, unfiltered->values})
        for (std::size_t axis = 0; axis < 2; ++axis)
          ASSERT_EQ(std::bit_cast<std::uint32_t>(values[axis]), std::bit_cast<std::uint32_t>(expected[axis]))
              << "map " << seed << " at " << x << ", " << y << ": " << values[axis] << ", expected " << expected[axis];
      ++counts[name_of_stage(found->stage)];
      counts["a slope of 0"] += expected[0] == 0 || expected[1] == 0;
      counts["a slope other than 0"] += expected[0] != 0 || expected[1] != 0;
    }
  }
  counts.expect_all({"binary64", "double-double", "a slope of 0", "a slope other than 0"});
}

// 1/3 + 2/3 and a little: only exact numbers see that the slope is midway between two binary32 numbers; or that it is not, by
// the tail of a Gaussian, e^-500000 or so.
TEST(texture_scheme, a_slope_that_is_a_tie_is_rounded_to_even_and_one_beside_it_is_not_on_both_sides) {
  const auto rising = [](float run, float height) {
    return height::Part{height::Polygons{{{-run, -height}, {0, 0}, {run, height}}}};
  };
  const height::Gaussian far{-1000, 2, 1, 1};
  struct Case {
    float more;
    std::optional<height::Part> tail;
    float expected;
  };
  const float one = 1, above = 1 + 0x1p-23F, next = 1 + 0x1p-22F;
  for (const auto& [more, tail, expected] :
       {Case{0x1p-24F, std::nullopt, one}, Case{0x1.8p-23F, std::nullopt, next}, Case{0x1p-24F, height::Part{far, true}, above},
        Case{0x1p-24F, height::Part{far}, one}, Case{0x1.8p-23F, height::Part{far}, above},
        Case{0x1.8p-23F, height::Part{far, true}, next}}) {
    HeightMap map{{rising(3, 1), rising(3, 2), rising(2, 2 * more)}};
    if (tail) map.parts.push_back(*tail);
    const auto fast_map = fast::HeightMapField::build(map, height::Mode::force_shaded, 1);
    const auto reference_map = reference::HeightMapField::build(map, height::Mode::force_shaded, 1);
    const auto found = std::get<fast::HeightMapField>(fast_map).slopes(1, 2);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->values[0], expected) << more << ' ' << tail.has_value();
    EXPECT_EQ(found->values[1], 0);
    EXPECT_EQ(found->stage, fast::Stage::wide);
    EXPECT_EQ(std::get<reference::HeightMapField>(reference_map).slopes(1, 2), found->values)
        << more << ' ' << tail.has_value();
  }
}

TEST(texture_scheme, is_the_reference_in_every_bit_on_random_meshes_and_maps) {
  tests::Occasions counts;
  constexpr std::size_t kTicksOfAMesh = 250;
  const std::size_t ticks = tests::drawn(24000);
  tests::MeshSource source(33);
  for (std::uint64_t seed = 0; seed * kTicksOfAMesh < ticks; ++seed) {
    const tests::RandomMesh made = source.next();
    const mesh::CornerNormals normals = source.normals_of(made.mesh);
    const mesh::Texture texture{source.textures_of(made.mesh), random_map(seed)};
    const MeshRendering rendering{tests::checked(made.mesh),     normals,    made.sides,
                                  mesh::Shading::texture_scheme, kStiffness, texture};
    tests::BothSides both(rendering);
    const fast::Mesh& mesh = both.mesh();
    properties::MeshPath path(made.mesh, seed);
    for (std::size_t i = 0; i < kTicksOfAMesh; ++i) {
      const Position p = path.next();
      const mesh::GodObject state = both.state();
      const mesh::Tick expected = both.step(p, "mesh " + std::to_string(seed) + ", tick " + std::to_string(i));
      if (testing::Test::HasFailure()) return;

      fast::Arrival arrival{grid_point_of(mesh, state), fast::RestKind::none, 0, true};
      if (fast::in_domain(p)) {
        const Position read = fast::quantised(p);
        mesh::Tick tick;
        fast::arrive(mesh, arrival, read, kStiffness, mesh::Shading::texture_scheme, fast::FilteredStages(), tick);
        fast::ForceDecision decided;
        fast::mesh_force(mesh, arrival, fast::HandAndGoal(read), kStiffness, mesh::Shading::texture_scheme, true, &decided);
        const fast::ForceStage stage = decided.numbers;
        const Position untilted = step(mesh, state, p, kStiffness, mesh::Shading::vertex_scheme).force;
        if (stage != fast::ForceStage::unshaded) {
          counts["force from binary64"] += stage == fast::ForceStage::binary64;
          counts["force from integers, rounded"] += stage == fast::ForceStage::from_integers;
          counts["force from wide numbers"] += stage == fast::ForceStage::wide;
          if (stage == fast::ForceStage::from_integers || stage == fast::ForceStage::wide) {
            EXPECT_EQ(decided.last, fast::Stage::wide) << tests::show(expected);
          }
          counts["a slope in double-double at most"] += decided.last == fast::Stage::double_double;
          ++counts[std::string("at ") + std::string(mesh::kPlaceNames[static_cast<std::size_t>(expected.after.place)])];
          ++counts[std::string(mesh::kSideNames[static_cast<std::size_t>(expected.after.side)])];
          ++counts[untilted == expected.force ? "not turned by the texture" : "turned by the texture"];
          counts["turned on an edge"] += expected.after.place == mesh::Place::edge && untilted != expected.force;
        }
      }
    }
  }
  counts.expect_all({"force from binary64", "force from integers, rounded", "force from wide numbers",
                     "a slope in double-double at most", "at vertex", "at edge", "at triangle", "front", "back",
                     "turned by the texture", "not turned by the texture", "turned on an edge"});
}

// A mesh with points of a texture in mm, its normals and its gradients.
MeshRendering textured(mesh::TriangleMesh triangles, const std::vector<std::array<mesh::TexturePoint, 3>>& points,
                       HeightMap map) {
  const auto checked = std::get<mesh::CheckedMesh>(mesh::check(std::move(triangles)));
  return {checked,
          mesh::corner_normals(checked).normals,
          mesh::Sides::front,
          mesh::Shading::texture_scheme,
          kStiffness,
          {mesh::corner_textures(checked, points), std::move(map)}};
}

HeightMap cylinder_cap() {
  return {{{height::CylinderCap{0.5F, 15.24F, 25.4F}}}};
}

TEST(texture_scheme, a_texture_from_a_box_turns_no_triangle_over_and_goes_by_no_faster_than_the_mesh) {
  const mesh::TriangleMesh sphere = mesh::icosphere(7, 20);
  const auto points = mesh::texture_from_box(sphere);
  const MeshRendering rendering = textured(sphere, points, cylinder_cap());
  for (std::size_t i = 0; i < sphere.triangles.size(); ++i) {
    const auto step = [&](std::size_t corner, std::size_t axis) {
      return static_cast<double>(points[i][corner][axis]) - static_cast<double>(points[i][0][axis]);
    };
    ASSERT_GT(step(1, 0) * step(2, 1) - step(2, 0) * step(1, 1), 0) << i;
    for (const mesh::CornerTexture& corner : rendering.texture.corners[i])
      for (const mesh::Normal& gradient : {corner.gradient_x, corner.gradient_y})
        ASSERT_LE(std::hypot(gradient[0], gradient[1], gradient[2]), 1 + 1e-6) << i;
  }
}

std::vector<std::array<mesh::TexturePoint, 3>> scaled(std::vector<std::array<mesh::TexturePoint, 3>> points, float scale) {
  for (auto& corners : points)
    for (mesh::TexturePoint& point : corners)
      for (float& number : point) number *= scale;
  return points;
}

std::string refusal(const std::vector<std::array<mesh::TexturePoint, 3>>& points) {
  const auto checked =
      std::get<mesh::CheckedMesh>(mesh::check({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}));
  return tests::thrown_by<std::invalid_argument>([&] { mesh::corner_textures(checked, points); });
}

TEST(texture_scheme, gradients_are_those_of_the_map_and_what_cannot_be_laid_over_a_mesh_is_refused) {
  const std::array<mesh::TexturePoint, 3> first{{{0, 0}, {1, 0}, {1, 1}}}, second{{{0, 0}, {1, 1}, {0, 1}}};
  const mesh::TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto checked = std::get<mesh::CheckedMesh>(mesh::check(square));
  for (const auto& corners : mesh::corner_textures(checked, scaled({first, second}, 3)))
    for (const mesh::CornerTexture& corner : corners) {
      EXPECT_EQ(corner.gradient_x, (mesh::Normal{3, 0, 0}));
      EXPECT_EQ(corner.gradient_y, (mesh::Normal{0, 3, 0}));
    }
  // The second triangle twice as fast along y, joined to the first at one corner only: a seam.
  const std::array<mesh::TexturePoint, 3> other{{{0, 0}, {1, 1}, {0, 2}}}, apart{{{0, 0}, {2, 2}, {0, 2}}};
  const auto joined = mesh::corner_textures(checked, {first, other}), split = mesh::corner_textures(checked, {first, apart});
  EXPECT_EQ(joined[0][0].gradient_y, joined[1][0].gradient_y);  // the mean of (0, 1) and (-1, 2)
  EXPECT_EQ(joined[0][0].gradient_y, (mesh::Normal{-0.5F, 1.5F, 0}));
  EXPECT_EQ(joined[0][1].gradient_y, (mesh::Normal{0, 1, 0}));
  EXPECT_EQ(split[0][0].gradient_y, (mesh::Normal{0, 1, 0}));
  EXPECT_EQ(split[1][0].gradient_y, (mesh::Normal{0, 2, 0}));
  // Turned over, with the same points along the common edge.
  const std::array<mesh::TexturePoint, 3> mirrored{{{0, 0}, {1, 1}, {2, 0}}};
  EXPECT_EQ(mesh::corner_textures(checked, {first, mirrored})[0][0].gradient_y, (mesh::Normal{0, 1, 0}));
  // 1 + 2^-24 is midway between two binary32 numbers.
  const auto tie = mesh::corner_textures(checked, {{{{{-0x1p-24F, 0}, {1, 0}, {1, 1}}}, second}});
  EXPECT_EQ(tie[0][1].gradient_x[0], 1);

  const std::array<mesh::TexturePoint, 3> line{{{0, 0}, {1, 1}, {2, 2}}};
  EXPECT_EQ(refusal({first, line}), "face 1 has no area in the texture: its three points lie on a line");
  EXPECT_EQ(refusal(scaled({first, second}, 10000)), "face 0 has a texture that goes by at 10000 mm/mm; expected 1000 at most");
  EXPECT_EQ(refusal({first}), "expected points of the texture for each face");
}

// A texture that a side cannot hold is refused by both.
TEST(texture_scheme, both_sides_refuse_the_same_textures) {
  const mesh::TriangleMesh plane = mesh::thin_wall(10, 10, 1, 1);
  const MeshRendering good = textured(plane, mesh::texture_from_above(plane), cylinder_cap());
  const auto are_refused = [&](const mesh::Texture& texture) {
    MeshRendering other = good;
    other.texture = texture;
    const bool is_refused = std::holds_alternative<ParameterError>(fast::GodObject::build(other));
    EXPECT_EQ(std::holds_alternative<ParameterError>(reference::GodObject::build(other)), is_refused);
    return is_refused;
  };
  EXPECT_FALSE(are_refused(good.texture));
  const auto with = [&](const auto& change) {
    mesh::Texture texture = good.texture;
    change(texture);
    return texture;
  };
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.corners.pop_back(); })));
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.corners[1][2].point[1] = 10001; })));
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.corners[1][2].point[0] = NAN; })));
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.corners[0][0].gradient_x[2] = 1001; })));
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.corners[0][0].gradient_y[0] = 0x1p-31F; })));
  EXPECT_TRUE(are_refused(with([](mesh::Texture& t) { t.map.parts.clear(); })));
}

}  // namespace
}  // namespace forceshade
