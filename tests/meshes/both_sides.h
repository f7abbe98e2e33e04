// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A god-object on both sides: the real-time path against the reference, in every bit of every tick.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fast/meshes/session.h"
#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"
#include "tests/support/mesh_source.h"

namespace forceshade::tests {

// Counts the occasions that a test is for.
struct Occasions {
  std::map<std::string, std::size_t> reached;

  std::size_t& operator[](const std::string& name) { return reached[name]; }
  void note(const mesh::Tick& tick) {
    ++reached["ticks"];
    ++reached[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)])];
    reached["more than one move"] += tick.moves > 1;
    if (tick.status == Status::invalid || tick.status == Status::free) return;
    ++reached["at " + std::string(mesh::kPlaceNames[static_cast<std::size_t>(tick.after.place)])];
    ++reached[std::string(mesh::kSideNames[static_cast<std::size_t>(tick.after.side)])];
    reached["slipping"] += tick.after.is_slipping;
  }
  void expect_all(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      std::printf("  %9zu %s\n", reached[name], name.c_str());
      EXPECT_GT(reached[name], 0U) << name;
    }
  }
};
inline const std::vector<std::string> kEverywhere{"ticks",       "free",  "touching", "at vertex",         "at edge",
                                                  "at triangle", "front", "back",     "more than one move"};

class BothSides {
 public:
  explicit BothSides(const MeshRendering& rendering)
      : mesh_(std::make_shared<const fast::Mesh>(fast_mesh(rendering))),
        definition_(built(reference::GodObject::build(rendering))),
        session_(mesh_, rendering.stiffness, rendering.shading, rendering.contact),
        stiffness_(rendering.stiffness),
        shading_(rendering.shading),
        contact_(fast::contact_in(*mesh_, rendering.contact)) {}

  // Expects of a session, of a path that is held as a session holds it, and of a step from the state in integers alone the
  // tick of the reference, which it returns; and of the former two that they allocate nothing.
  mesh::Tick step(const std::array<float, 3>& p, const std::string& where = "") {
    const mesh::Tick expected = definition_.step(p);
    const mesh::GodObject before = std::exchange(state_, expected.after);
    decisions_ = {};
    mesh::Tick arrived;
    const std::size_t allocated = allocations();
    const mesh::Tick in_session = session_.tick(p);
    if (fast::in_domain(p))
      fast::arrive(*mesh_, at_, fast::quantised(p), stiffness_, shading_, fast::CountedStages{&decisions_[0], &decisions_[1]},
                   arrived, contact_);
    EXPECT_EQ(allocations(), allocated) << where;
    arrived.after = object_of(*mesh_, at_);
    const mesh::Tick exact = fast::step(*mesh_, before, p, stiffness_, shading_, fast::ExactStages(), contact_);
    for (const auto& [how, found] : {std::pair("in a session", in_session), {"held", arrived}, {"in integers", exact}})
      EXPECT_TRUE(is_same(found, expected)) << where << ", " << how << ": " << show(found) << ", expected " << show(expected);
    return expected;
  }
  // The fast path goes on from the state as though it were given from outside.
  void resume() {
    session_.resume(state_);
    at_ = arrival_of(*mesh_, state_, contact_);
  }

  const fast::Mesh& mesh() const { return *mesh_; }
  const mesh::GodObject& state() const { return state_; }
  const reference::GodObjectSession& definition() const { return definition_; }
  fast::MeshSession& session() { return session_; }
  // The number of decisions of the last tick, in binary64 and in integers.
  const std::array<std::size_t, 2>& decisions() const { return decisions_; }

 private:
  std::shared_ptr<const fast::Mesh> mesh_;
  reference::GodObjectSession definition_;
  fast::MeshSession session_;
  fast::Arrival at_;
  mesh::GodObject state_;
  float stiffness_;
  mesh::Shading shading_;
  mesh::Contact contact_;
  std::array<std::size_t, 2> decisions_{};
};

// One tick of a random path.
struct ComparedTick {
  BothSides& both;
  const mesh::GodObject& before;
  const std::array<float, 3>& position;
  const MeshRendering& rendering;
  const mesh::Tick& expected;
};
using Renderings = std::function<MeshRendering(tests::MeshSource&, const tests::RandomMesh&, mesh::Shading)>;

// Every family of meshes, all shadings but the one that needs a texture: both sides are the same, also from a state.
inline void expect_reference(std::uint64_t meshes, std::size_t ticks_of_a_mesh, Occasions& occasions,
                             const Renderings& rendering_of, const std::function<void(const ComparedTick&)>& look) {
  constexpr std::uint64_t kShadings = mesh::kShadingNames.size() - 1;
  tests::MeshSource source(41);
  for (std::uint64_t seed = 0; seed < drawn(meshes); ++seed) {
    const tests::RandomMesh made = source.next();
    const MeshRendering rendering = rendering_of(source, made, static_cast<mesh::Shading>(seed % kShadings));
    BothSides both(rendering);
    properties::MeshPath path(made.mesh, seed);
    for (std::size_t i = 0; i < ticks_of_a_mesh; ++i) {
      const std::array<float, 3> p = path.next();
      if (i % 50 == 49) both.resume();
      if (i % 3 != 0) both.session().look_ahead();  // without any trace in what follows
      const mesh::GodObject before = both.state();
      const mesh::Tick tick = both.step(p, "mesh " + std::to_string(seed) + ", " +
                                               std::string(tests::kMeshFamilies[made.family]) + ", tick " + std::to_string(i));
      if (testing::Test::HasFailure()) return;
      occasions["decided in binary64"] += both.session().stage() == fast::Stage::binary64;
      occasions["decided in wide numbers"] += both.session().stage() == fast::Stage::wide;
      occasions.note(tick);
      look({both, before, p, rendering, tick});
    }
  }
}

}  // namespace forceshade::tests
