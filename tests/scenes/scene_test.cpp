// SPDX-License-Identifier: BSD-3-Clause
// Scenes in real time: the reference in every bit, and what follows from their definition.

#include <cmath>
#include <cstdlib>

#include "fast/scenes/pose.h"
#include "tests/meshes/both_sides.h"
#include "tests/scenes/poses.h"

namespace forceshade {
namespace {

using Position = std::array<float, 3>;

// Some objects on both sides, with what their paths are made of.
struct BothScenes {
  std::vector<mesh::TriangleMesh> meshes;
  std::vector<fast::GodObject> fast;
  std::vector<reference::GodObject> exact;

  void add(const MeshRendering& rendering) {
    meshes.push_back(rendering.mesh());
    fast.push_back(tests::built(fast::GodObject::build(rendering)));
    exact.push_back(tests::built(reference::GodObject::build(rendering)));
  }
};

// With friction, if the material has some.
void add_random(properties::MeshSource& source, BothScenes& scenes, std::uint64_t seed) {
  const properties::RandomMesh made = source.next();
  MeshRendering rendering = tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, 0.3F);
  if (seed % 2 == 0) rendering.shading = mesh::Shading::none;
  if (seed % 3 == 0) {
    rendering.contact = mesh::Contact::friction;
    rendering.materials = source.materials_of(made.mesh);
  }
  scenes.add(rendering);
}

bool is_same(const scene::Tick& a, const scene::Tick& b) {
  const auto bits = [](const Position& force) { return std::bit_cast<std::array<std::uint32_t, 3>>(force); };
  return a.status == b.status && bits(a.force) == bits(b.force);
}
std::string show(const scene::Tick& tick) {
  std::string words(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)]);
  for (const float one : tick.force) words += " " + std::to_string(one);
  return words;
}

// More by hand: FORCESHADE_SCENE_TICKS.
TEST(scene, is_the_reference_in_every_bit_on_random_objects_that_move) {
  constexpr std::uint64_t kTicksOfAScene = 200;
  const char* const wanted = std::getenv("FORCESHADE_SCENE_TICKS");
  const std::uint64_t count = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) / kTicksOfAScene : 66;
  properties::MeshSource source(7);
  tests::Occasions occasions;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    BothScenes scenes;
    std::vector<tests::PosePath> motions;
    for (std::uint64_t i = 0; i <= seed % 4; ++i) {
      add_random(source, scenes, seed + i);
      motions.emplace_back(100 * seed + i);
    }
    fast::SceneSession session(scenes.fast);
    reference::SceneSession definition(scenes.exact);
    const std::size_t felt = seed % scenes.meshes.size();
    properties::MeshPath path(scenes.meshes[felt], seed);
    std::vector<scene::Pose> poses(motions.size());
    for (std::uint64_t i = 0; i < kTicksOfAScene; ++i) {
      for (std::size_t object = 0; object < motions.size(); ++object) poses[object] = motions[object].next();
      const Position p = tests::about_in_world(poses[felt], path.next());
      const std::size_t allocated = tests::allocations();
      const scene::Tick found = session.tick(p, poses);
      ASSERT_EQ(tests::allocations(), allocated);
      const scene::Tick expected = definition.step(p, poses);
      ASSERT_TRUE(is_same(found, expected))
          << "scene " << seed << ", tick " << i << ": expected " << show(expected) << ", found " << show(found);
      std::size_t touching = 0;
      for (std::size_t object = 0; object < motions.size(); ++object) {
        ASSERT_TRUE(tests::is_same(session.of(object), definition.of(object)))
            << "scene " << seed << ", tick " << i << ", object " << object << ": expected "
            << tests::show(definition.of(object)) << ", found " << tests::show(session.of(object));
        touching += session.of(object).status == mesh::TickStatus::touching;
      }
      ++occasions[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(found.status)])];
      occasions["several touch"] += touching > 1;
      occasions["decided in binary64"] += session.stage() == fast::Stage::binary64;
      occasions["decided in wide numbers"] += session.stage() == fast::Stage::wide;
    }
  }
  occasions.expect_all({"free", "touching", "invalid", "several touch", "decided in binary64", "decided in wide numbers"});
}

// The sums alone, of as many objects as there can be: what cancels, ties, and quaternions whose components are far apart.
TEST(scene, sums_are_decided_by_exact_numbers_where_binary64_does_not) {
  const auto sum = [](const std::vector<scene::Pose>& poses, const std::vector<Position>& forces) {
    std::vector<fast::PlacedForce> placed;
    for (std::size_t i = 0; i < poses.size(); ++i) placed.push_back({&poses[i], forces[i]});
    return fast::exact_sum(placed);
  };
  const scene::Pose turned{{}, {1, 0x1p-30F, 0, 0.3F}}, other{{}, {0x1p-30F, 2, 0x1p-29F, 0x1.fffffep-1F}};
  // Opposite forces of one object twice cancel.
  EXPECT_EQ(sum({turned, turned}, {{1, 2, 3}, {-1, -2, -3}}), (Position{0, 0, 0}));
  // Half of the last place decides by what is added to it: 1 + 2^-24 is a tie, which goes to the even number.
  const scene::Pose unturned;
  EXPECT_EQ(sum({unturned, unturned}, {{1, 0, 0}, {0x1p-24F, 0, 0}}), (Position{1, 0, 0}));
  EXPECT_EQ(sum({unturned, unturned, unturned}, {{1, 0, 0}, {0x1p-24F, 0, 0}, {0x1p-149F, 0, 0}}),
            (Position{0x1.000002p0F, 0, 0}));
  // The largest and the smallest forces of 32 objects, of which 31 cancel but for the last.
  std::vector<scene::Pose> poses;
  std::vector<Position> forces;
  for (std::size_t i = 0; i + 2 < scene::kMostObjects; i += 2) {
    poses.insert(poses.end(), 2, i % 4 == 0 ? turned : other);
    forces.insert(forces.end(), {{0x1.fffffep25F, 0x1p-149F, 3}, {-0x1.fffffep25F, -0x1p-149F, -3}});
  }
  poses.insert(poses.end(), {other, unturned});
  forces.insert(forces.end(), {{0, 0, 0}, {0x1p-149F, 5, 0}});
  ASSERT_EQ(poses.size(), scene::kMostObjects);
  EXPECT_EQ(sum(poses, forces), (Position{0x1p-149F, 5, 0}));
}

TEST(scene, of_one_object_that_is_not_moved_is_the_mesh_in_every_bit) {
  properties::MeshSource source(11);
  std::size_t touching = 0;
  for (std::uint64_t seed = 0; seed < 22; ++seed) {
    BothScenes scenes;
    add_random(source, scenes, seed);
    fast::SceneSession session(scenes.fast);
    const auto alone = scenes.fast[0].open();
    properties::MeshPath path(scenes.meshes[0], seed);
    for (int i = 0; i < 200; ++i) {
      const Position p = path.next();
      const mesh::Tick expected = alone->tick(p);
      const scene::Tick found = session.tick(p, std::array{scene::Pose{{}, {0.7F, 0, 0, 0}}});
      ASSERT_TRUE(is_same(found, {expected.status, expected.force})) << show(found) << ", expected " << tests::show(expected);
      ASSERT_TRUE(tests::is_same(session.of(0), expected));
      touching += found.status == mesh::TickStatus::touching;
    }
  }
  EXPECT_GT(touching, 0U);
}

// A quarter turn about z takes (x, y, z) to (-y, x, z).
TEST(scene, turned_by_a_right_angle_has_its_forces_turned_in_every_bit) {
  properties::MeshSource source(13);
  const scene::Pose quarter{{}, {0.5F, 0, 0, 0.5F}};
  std::size_t touching = 0;
  for (std::uint64_t seed = 0; seed < 22; ++seed) {
    BothScenes scenes;
    add_random(source, scenes, seed);
    fast::SceneSession session(scenes.fast);
    const auto alone = scenes.fast[0].open();
    properties::MeshPath path(scenes.meshes[0], seed);
    for (int i = 0; i < 200; ++i) {
      const Position p = path.next();
      const mesh::Tick expected = alone->tick(p);
      const scene::Tick found = session.tick({-p[1], p[0], p[2]}, std::array{quarter});
      const Position turned{0.0F - expected.force[1], expected.force[0], expected.force[2]};
      ASSERT_TRUE(is_same(found, {expected.status, turned})) << show(found) << ", expected " << tests::show(expected);
      touching += found.status == mesh::TickStatus::touching;
    }
  }
  EXPECT_GT(touching, 0U);
}

// A plate of 20 mm x 20 mm at z = 0.
MeshRendering plate(float friction) {
  MeshRendering rendering =
      tests::unshaded({{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}}, mesh::Sides::both);
  if (friction > 0) {
    rendering.contact = mesh::Contact::friction;
    rendering.materials = {{{{}, friction, friction}}, {}};
  }
  return rendering;
}

TEST(scene, an_object_that_sweeps_over_a_resting_hand_catches_it) {
  BothScenes scenes;
  scenes.add(plate(0));
  fast::SceneSession session(scenes.fast);
  const Position hand{1, 2, 0.5F};
  EXPECT_EQ(session.tick(hand, std::array{scene::Pose()}).status, mesh::TickStatus::free);
  const scene::Tick caught = session.tick(hand, std::array{scene::Pose{{0, 0, 2}, {1, 0, 0, 0}}});
  EXPECT_EQ(caught.status, mesh::TickStatus::touching);
  EXPECT_EQ(caught.force, (Position{0, 0, 1.5F}));
}

TEST(scene, a_hand_that_sticks_is_dragged_and_one_that_does_not_is_left) {
  for (const float friction : {0.0F, 1.0F}) {
    BothScenes scenes;
    scenes.add(plate(friction));
    fast::SceneSession session(scenes.fast);
    const Position hand{0, 0, -1};
    EXPECT_EQ(session.tick({0, 0, 1}, std::array{scene::Pose()}).status, mesh::TickStatus::free);
    EXPECT_EQ(session.tick(hand, std::array{scene::Pose()}).force, (Position{0, 0, 1}));
    const scene::Tick moved = session.tick(hand, std::array{scene::Pose{{0.5F, 0, 0}, {1, 0, 0, 0}}});
    EXPECT_EQ(moved.force, (Position{friction > 0 ? 0.5F : 0.0F, 0, 1})) << "friction " << friction;
  }
}

TEST(scene, an_invalid_pose_gives_no_force_and_keeps_the_states) {
  BothScenes scenes;
  scenes.add(plate(0));
  scenes.add(plate(0));
  fast::SceneSession session(scenes.fast);
  const std::array poses{scene::Pose(), scene::Pose{{0, 0, -50}, {1, 0, 0, 0}}};
  EXPECT_EQ(session.tick({0, 0, 1}, poses).status, mesh::TickStatus::free);
  EXPECT_EQ(session.tick({0, 0, -1}, poses).status, mesh::TickStatus::touching);
  auto wrong = poses;
  wrong[1].rotation = {0, 0, 0, 0};
  const scene::Tick none = session.tick({0, 0, -1}, wrong);
  EXPECT_EQ(none.status, mesh::TickStatus::invalid);
  EXPECT_EQ(none.force, (Position{0, 0, 0}));
  EXPECT_EQ(session.tick({0, 0, -1}, std::span(poses).first(1)).status, mesh::TickStatus::invalid) << "a pose is missing";
  EXPECT_EQ(session.tick({0, 0, NAN}, poses).status, mesh::TickStatus::invalid);
  EXPECT_EQ(session.tick({0, 0, -2}, poses).force, (Position{0, 0, 2})) << "it goes on where it was";
}

TEST(scene, has_1_to_32_objects) {
  BothScenes scenes;
  EXPECT_THROW(fast::SceneSession{scenes.fast}, std::invalid_argument);
  EXPECT_THROW(reference::SceneSession{scenes.exact}, std::invalid_argument);
  for (std::size_t i = 0; i <= scene::kMostObjects; ++i) scenes.add(plate(0));
  EXPECT_THROW(fast::SceneSession{scenes.fast}, std::invalid_argument);
  EXPECT_THROW(reference::SceneSession{scenes.exact}, std::invalid_argument);
  scenes.fast.pop_back();
  EXPECT_EQ(fast::SceneSession(scenes.fast).size(), scene::kMostObjects);
}

}  // namespace
}  // namespace forceshade
