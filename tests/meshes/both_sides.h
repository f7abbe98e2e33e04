// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A contact rule on both sides: the real-time path against the reference, in every bit.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fast/meshes/session.h"
#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "properties/mesh_source.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade::tests {

// Counts the occasions that a test is for.
struct Occasions {
  std::map<std::string, std::size_t> reached;

  std::size_t& operator[](const std::string& name) { return reached[name]; }
  void expect_all(const std::vector<const char*>& names) {
    for (const char* name : names) {
      std::printf("  %9zu %s\n", reached[name], name);
      EXPECT_GT(reached[name], 0U) << name;
    }
  }
};

// One tick of a random path.
struct ComparedTick {
  const fast::Mesh& mesh;
  const mesh::GodObject& before;
  const std::array<float, 3>& position;
  mesh::Shading shading;
  const mesh::Tick& expected;
};

// Every family of meshes, all shadings but the one that needs a texture: what a session gives, and what exact numbers alone
// give, is the reference's tick in every bit, without an allocation.
inline void expect_reference(
    std::uint64_t meshes, std::size_t ticks_of_a_mesh, Occasions& occasions,
    const std::function<MeshRendering(properties::MeshSource&, const properties::RandomMesh&, mesh::Shading)>& rendering_of,
    const std::function<void(const ComparedTick&)>& look) {
  constexpr std::uint64_t kShadings = mesh::kShadingNames.size() - 1;
  properties::MeshSource source(41);
  for (std::uint64_t seed = 0; seed < drawn(meshes); ++seed) {
    const properties::RandomMesh made = source.next();
    const auto shading = static_cast<mesh::Shading>(seed % kShadings);
    const MeshRendering rendering = rendering_of(source, made, shading);
    const auto built = std::make_shared<const fast::Mesh>(fast_mesh(rendering));
    reference::GodObjectSession definition(tests::built(reference::GodObject::build(rendering)));
    fast::MeshSession session(built, rendering.stiffness, shading, rendering.contact);
    properties::MeshPath path(made.mesh, seed);
    mesh::GodObject state;
    for (std::size_t i = 0; i < ticks_of_a_mesh; ++i) {
      const std::array<float, 3> p = path.next();
      const mesh::Tick expected = definition.step(p);
      const std::size_t allocated = allocations();
      const mesh::Tick in_session = session.tick(p);
      ASSERT_EQ(allocations(), allocated);
      const mesh::Tick exact =
          fast::step(*built, state, p, rendering.stiffness, shading, fast::ExactStages(), rendering.contact);
      for (const mesh::Tick& found : {in_session, exact})
        ASSERT_TRUE(is_same(found, expected)) << "mesh " << seed << ", " << properties::kMeshFamilies[made.family] << ", tick "
                                              << i << ": expected " << show(expected) << ", found " << show(found);
      occasions["decided in binary64"] += session.stage() == fast::Stage::binary64;
      occasions["decided in wide numbers"] += session.stage() == fast::Stage::wide;
      ++occasions[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(expected.status)])];
      look({*built, state, p, shading, expected});
      state = expected.after;
    }
  }
}

}  // namespace forceshade::tests
