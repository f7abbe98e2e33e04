// SPDX-License-Identifier: BSD-3-Clause
// A height map that is laid over a mesh turns the force (docs/meshes.md, the texture scheme): both sides, and what it promises.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/meshes/god_object.h"
#include "forceshade/properties/height_generators.h"
#include "forceshade/properties/mesh_generators.h"
#include "forceshade/reference/height_map_field.h"
#include "forceshade/reference/meshes/god_object.h"
#include "forceshade/tests/meshes/god_object_paths.h"

namespace forceshade {
namespace {

using Position = std::array<float, 3>;

constexpr float kStiffness = 0.3F;  // N/mm

std::map<std::string, std::size_t> counts;

void expect_all(const std::vector<const char*>& names) {
  for (const char* name : names) {
    std::printf("  %9zu %s\n", counts[name], name);
    EXPECT_GT(counts[name], 0U) << name;
  }
  counts.clear();
}

// More by hand: FORCESHADE_TEXTURE_TICKS.
std::size_t ticks_of_a_test(std::size_t usual) {
  const char* wanted = std::getenv("FORCESHADE_TEXTURE_TICKS");
  return wanted == nullptr ? usual : std::strtoull(wanted, nullptr, 10);
}

HeightMap random_map(std::uint64_t seed) {
  return {properties::any_height_map()(rc::Random(seed), 40).value().map.parts};
}

fast::Mesh built(const mesh::TriangleMesh& triangles, const mesh::CornerNormals& normals, mesh::Sides sides,
                 const mesh::Texture& texture) {
  auto mesh = fast::Mesh::build(triangles, normals, sides, texture);
  if (const auto* message = std::get_if<std::string>(&mesh)) throw std::runtime_error(*message);
  return std::get<fast::Mesh>(std::move(mesh));
}

reference::GodObject definition(const mesh::TriangleMesh& triangles, const mesh::CornerNormals& normals, mesh::Sides sides,
                                const mesh::Texture& texture) {
  auto god_object = reference::GodObject::build(triangles, normals, sides, mesh::Shading::texture_scheme, kStiffness, texture);
  if (const auto* error = std::get_if<ParameterError>(&god_object)) throw std::runtime_error(error->message());
  return std::get<reference::GodObject>(std::move(god_object));
}

const char* name_of_stage(fast::Stage stage) {
  return stage == fast::Stage::binary64 ? "binary64" : stage == fast::Stage::double_double ? "double-double" : "wide";
}

TEST(texture_scheme, slopes_are_the_reference_s_in_every_bit_on_random_maps_and_with_every_filter) {
  constexpr std::uint64_t kMaps = 400;
  std::mt19937_64 random(5);
  for (std::uint64_t seed = 0; seed < kMaps; ++seed) {
    const HeightMap map = random_map(seed);
    const auto fast_map = fast::HeightMapField::build(map, height::Rendering::force_shaded, 1);
    const auto reference_map = reference::HeightMapField::build(map, height::Rendering::force_shaded, 1);
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
  expect_all({"binary64", "double-double", "wide", "a slope of 0", "a slope other than 0"});
}

TEST(texture_scheme, is_the_reference_in_every_bit_on_random_meshes_and_maps) {
  constexpr std::size_t kTicksOfAMesh = 250;
  const std::size_t ticks = ticks_of_a_test(20000);
  properties::MeshSource source(33);
  for (std::uint64_t seed = 0; seed * kTicksOfAMesh < ticks; ++seed) {
    const properties::RandomMesh made = source.next();
    const mesh::CornerNormals normals = source.normals_of(made.mesh);
    const mesh::Texture texture{source.textures_of(made.mesh), random_map(seed)};
    const fast::Mesh mesh = built(made.mesh, normals, made.sides, texture);
    reference::GodObjectSession session(definition(made.mesh, normals, made.sides, texture));
    properties::MeshPath path(made.mesh, seed);
    mesh::GodObject state;
    for (std::size_t i = 0; i < kTicksOfAMesh; ++i) {
      const Position p = path.next();
      const mesh::Tick expected = session.step(p);
      for (const mesh::Tick& found : {step(mesh, state, p, kStiffness, mesh::Shading::texture_scheme),
                                      step(mesh, state, p, kStiffness, mesh::Shading::texture_scheme, fast::ExactStages())})
        ASSERT_TRUE(tests::is_same(found, expected))
            << "mesh " << seed << ", " << properties::kMeshFamilies[made.family] << ", tick " << i << ": expected "
            << tests::show(expected) << ", found " << tests::show(found);
      const fast::MeshTick tick = step(mesh, spot_of(mesh, state), p, kStiffness, mesh::Shading::texture_scheme);
      if (tick.status != mesh::TickStatus::invalid) {
        fast::ForceStage stage{};
        const Position read{fast::quantised(p[0]), fast::quantised(p[1]), fast::quantised(p[2])};
        fast::mesh_force(mesh, tick.arrival, read, kStiffness, mesh::Shading::texture_scheme, true, &stage);
        const Position untilted = step(mesh, state, p, kStiffness, mesh::Shading::vertex_scheme).force;
        if (stage != fast::ForceStage::unshaded) {
          counts["force from binary64"] += stage == fast::ForceStage::binary64;
          counts["force from integers, rounded"] += stage == fast::ForceStage::from_integers;
          counts["force from wide numbers"] += stage == fast::ForceStage::wide;
          ++counts[std::string("at ") + std::string(mesh::kPlaceNames[static_cast<std::size_t>(expected.after.place)])];
          ++counts[std::string(mesh::kSideNames[static_cast<std::size_t>(expected.after.side)])];
          ++counts[untilted == expected.force ? "not turned by the texture" : "turned by the texture"];
          counts["turned on an edge"] += expected.after.place == mesh::Place::edge && untilted != expected.force;
        }
      }
      state = expected.after;
    }
  }
  expect_all({"force from binary64", "force from integers, rounded", "force from wide numbers", "at vertex", "at edge",
              "at triangle", "front", "back", "turned by the texture", "not turned by the texture", "turned on an edge"});
}

}  // namespace
}  // namespace forceshade
