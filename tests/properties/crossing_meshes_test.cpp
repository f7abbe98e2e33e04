// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are not regular as subjects: every property holds of the fast path, and what is said of them is weaker.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <numbers>

#include "forceshade/meshes.h"
#include "forceshade/properties.h"
#include "properties/mesh_energy.h"
#include "properties/mesh_subject.h"
#include "properties/worst_tick.h"
#include "rendering/meshes/make.h"
#include "tests/support/drawn.h"
#include "tests/support/mesh_source.h"

namespace forceshade::properties {
namespace {

// A star and its copy that crosses it, a face that is there twice, and one without area.
MeshRendering crossing_stars(std::uint64_t seed, mesh::Shading shading, mesh::Materials materials) {
  tests::MeshSource source(seed);
  mesh::TriangleMesh mesh = source.of_family(7).mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t triangles = mesh.triangles.size();
  const Eigen::Vector3d aside = (vector_of(mesh.vertices[1]) - vector_of(mesh.vertices[0])) / 2;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    mesh::Vertex moved = mesh.vertices[v];
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis] += static_cast<float>(aside[static_cast<Eigen::Index>(axis)]);
    mesh.vertices.push_back(moved);
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + vertices, b + vertices, c + vertices});
  }
  mesh.triangles.push_back(mesh.triangles.front());
  mesh.triangles.push_back({0, 0, 1});
  MeshRendering rendering{std::get<mesh::CheckedMesh>(mesh::check_any(std::move(mesh)))};
  rendering.sides = mesh::usual_sides(rendering.checked);
  rendering.shading = shading;
  rendering.stiffness = 0.3F;
  if (shading != mesh::Shading::none) rendering.normals = mesh::corner_normals(rendering.checked).normals;
  if (!materials.list.empty()) {
    rendering.contact = mesh::Contact::friction;
    for (std::size_t t = 0; t < rendering.mesh().triangles.size(); ++t)
      materials.of_triangle.push_back(static_cast<std::uint32_t>(t % materials.list.size()));
    rendering.materials = std::move(materials);
  }
  return rendering;
}

TEST(crossing_meshes, have_every_property) {
  const mesh::Materials smooth, rough{{{2.0F, 0.4F, 0.3F}, {0.1F, 0, 0}}, {}};
  for (std::uint64_t seed = 1; seed <= tests::drawn(3); ++seed)
    for (const mesh::Materials& materials : {smooth, rough})
      for (const mesh::Shading shading : {mesh::Shading::none, mesh::Shading::vertex_scheme}) {
        const MeshRendering rendering = crossing_stars(seed, shading, materials);
        ASSERT_FALSE(rendering.checked.is_regular());
        const MeshSubject subject("stars", rendering);
        for (const PropertyResult& result : run_properties(subject, static_cast<int>(tests::drawn(40)), 7))
          EXPECT_TRUE(result.held) << seed << ", " << name_of(shading) << ", " << result.name << ": " << result.counterexample;
      }
}

TEST(crossing_meshes, say_what_they_are) {
  const MeshRendering rendering = crossing_stars(1, mesh::Shading::vertex_scheme, {});
  EXPECT_NE(parameters_in_words(identity_of("stars.off", rendering)).find("any set"), std::string::npos);
  const MeshSubject subject("stars.off", rendering);
  EXPECT_EQ(subject.expected().jumps.at(1), "where it leaves a line or a point in which triangles meet");
  const std::vector<std::string> parts = subject.parts();
  EXPECT_TRUE(parts.at(1).starts_with("at a rest inside a triangle, where no other plane's is, the shading gives at most "))
      << parts[1];
  EXPECT_TRUE(parts.at(2).starts_with("the longest tick that a search found looks at ")) << parts[2];
  const auto last = static_cast<std::uint32_t>(rendering.mesh().triangles.size() - 1);
  EXPECT_FALSE(has_area(rendering.mesh(), last));
  EXPECT_EQ(largest_turn(rendering, last), 0);
}

TEST(crossing_meshes, have_the_energy_that_any_mesh_can_have) {
  const mesh::TriangleMesh crossing{{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 1, -1}, {2, 1, 1}, {6, 1, 0}},
                                    {{0, 1, 2}, {3, 4, 5}}};
  MeshRendering rendering{std::get<mesh::CheckedMesh>(mesh::check_any(crossing)), {}, mesh::Sides::both};
  rendering.stiffness = 0.5F;
  EXPECT_EQ(why_no_energy_bound(rendering), "");
  EXPECT_EQ(largest_turns(rendering).most(), 0);
  rendering.shading = mesh::Shading::vertex_scheme;
  rendering.normals = mesh::corner_normals(rendering.checked).normals;
  const LargestTurns turns = largest_turns(rendering);
  EXPECT_LT(turns.inside, 1e-6) << "the normals are the triangles' own";
  EXPECT_EQ(turns.edges, std::numbers::sqrt2);
  EXPECT_EQ(turns.vertices, std::numbers::sqrt2);
  EXPECT_EQ(turns.inside_at_least, 0);
}

TEST(crossing_meshes, have_a_longest_tick) {
  mesh::TriangleMesh twice = mesh::icosphere(10, 2);
  twice.triangles.push_back(twice.triangles.front());
  const MeshRendering rendering{
      .checked = std::get<mesh::CheckedMesh>(mesh::check_any(std::move(twice))), .sides = mesh::Sides::both, .stiffness = 1};
  const WorstTick worst = worst_tick(rendering);
  EXPECT_GT(worst.looks, 8);
  EXPECT_GT(worst.moves, 2);
  EXPECT_FALSE(worst.is_unfinished);
  EXPECT_TRUE(words_of(worst).ends_with("none begins a move after 16384 looks, and none was unfinished for that reason"));
}

}  // namespace
}  // namespace forceshade::properties
