// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object on random paths on random meshes, and its states as exact points.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "reference/meshes/descent.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/support/drawn.h"
#include "tests/support/mesh_source.h"

namespace forceshade::tests {

using Position = std::array<float, 3>;

// By the contact rule friction.
inline reference::GodObject built(const mesh::TriangleMesh& mesh, const mesh::CornerNormals& normals, mesh::Sides sides,
                                  float stiffness, const mesh::Materials& materials = {}) {
  MeshRendering rendering = shaded(mesh, normals, sides, stiffness);
  rendering.contact = mesh::Contact::friction;
  rendering.materials = materials;
  return built(reference::GodObject::build(rendering));
}

// A random mesh with its god-object, shaded. Without materials it has no friction.
struct Scene {
  Scene(const tests::RandomMesh& random, mesh::CornerNormals corner_normals, mesh::Materials of_mesh)
      : made(random),
        normals(std::move(corner_normals)),
        given(std::move(of_mesh)),
        god_object(built(made.mesh, normals, made.sides, kStiffness, given)),
        surface(made.mesh),
        crossings(surface),
        materials(surface, given, kStiffness) {}

  reference::meshes::Ground ground() const { return {surface, crossings, made.sides, materials}; }

  static constexpr float kStiffness = 0.7F;
  tests::RandomMesh made;
  mesh::CornerNormals normals;
  mesh::Materials given;
  reference::GodObject god_object;
  reference::meshes::Surface surface;
  reference::meshes::Crossings crossings;
  reference::meshes::SurfaceMaterials materials;
};

struct Step {
  mesh::GodObject before;
  Position position;
  mesh::Tick tick;
};

inline bool is_touching(const mesh::GodObject& state) {
  return state.place == mesh::Place::vertex || state.place == mesh::Place::edge || state.place == mesh::Place::triangle;
}

inline reference::meshes::GridPoint point_of(const reference::meshes::Surface& surface, const mesh::GodObject& state) {
  const std::size_t index =
      state.place == mesh::Place::edge ? surface.edge_between(state.index[0], state.index[1]) : state.index[0];
  return {{state.place, index}, state.parameter};
}

inline reference::meshes::Vector place_of(const reference::meshes::Surface& surface, const mesh::GodObject& state) {
  return is_touching(state) ? surface.position(point_of(surface, state)) : reference::meshes::exact_point(state.position);
}

inline reference::meshes::Integer squared_distance(const reference::meshes::Surface& surface, const mesh::GodObject& state,
                                                   const Position& position) {
  const reference::meshes::Vector off = place_of(surface, state) - reference::meshes::exact_point(position);
  return dot(off, off);
}

// Calls check(scene, step, counts) for each tick of a random path on each of random meshes, every family in turn, and prints
// the counts. A name that stands in `expected` must have been counted: where a quarter of the meshes does not reach all names,
// more are drawn. With friction there are a third of the meshes.
using Counts = std::map<std::string, int>;
enum class Friction { none, random };
inline constexpr std::array<Friction, 2> kEachFriction{Friction::none, Friction::random};
template <class Check>
void on_random_paths(std::uint64_t seed, int meshes, int ticks, const std::vector<std::string>& expected, Check check,
                     Friction friction = Friction::none) {
  tests::MeshSource source(seed);
  Counts counts;
  if (friction == Friction::random) meshes /= 3;
  std::vector<std::string> names{"free", "touching", "invalid", "vertex", "edge", "triangle", "back"};
  names.insert(names.end(), expected.begin(), expected.end());
  if (friction == Friction::random) names.emplace_back("slipping");
  const auto are_reached = [&] {
    return std::ranges::all_of(names, [&](const std::string& name) { return counts[name] > 0; });
  };
  const int few = static_cast<int>(drawn(static_cast<std::size_t>(meshes))), most = std::max(few, meshes);
  for (int i = 0; i < most && (i < few || !are_reached()) && !testing::Test::HasFailure(); ++i) {
    const tests::RandomMesh made = source.next();
    mesh::CornerNormals normals = source.normals_of(made.mesh);
    const Scene scene(made, std::move(normals),
                      friction == Friction::none ? mesh::Materials() : source.materials_of(made.mesh));
    properties::MeshPath path(made.mesh, seed + static_cast<std::uint64_t>(i));
    mesh::GodObject state;
    for (int k = 0; k < ticks && !testing::Test::HasFailure(); ++k) {
      const Position position = path.next();
      const Step step{state, position, scene.god_object.step(state, position)};
      SCOPED_TRACE("mesh " + std::to_string(i) + ", " + std::string(tests::kMeshFamilies[made.family]) + ", tick " +
                   std::to_string(k) + ": from " + feature_text(state) + " to " + show(step.tick));
      ++counts[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(step.tick.status)])];
      if (is_touching(step.tick.after))
        ++counts[std::string(mesh::kPlaceNames[static_cast<std::size_t>(step.tick.after.place)])];
      if (step.tick.after.side == mesh::Side::back) ++counts["back"];
      if (step.tick.after.is_slipping) ++counts["slipping"];
      check(scene, step, counts);
      state = step.tick.after;
    }
  }
  for (const auto& [name, count] : counts) std::printf("  %8d %s\n", count, name.c_str());
  for (const std::string& name : names) EXPECT_GT(counts[name], 0) << name;
  EXPECT_EQ(counts["slipping"] > 0, friction == Friction::random);
}

}  // namespace forceshade::tests
