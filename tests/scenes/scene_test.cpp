// SPDX-License-Identifier: BSD-3-Clause
// Scenes in real time: the reference in every bit, and what follows from their definition.

#include <bit>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "fast/scenes/pose.h"
#include "forceshade/renderer.h"
#include "tests/meshes/both_sides.h"
#include "tests/scenes/poses.h"

namespace forceshade {
namespace {

using Position = std::array<float, 3>;

Eigen::Vector3f vector(const Position& a) {
  return Eigen::Vector3f(a.data());
}

// Objects on both sides, at the beginning of a path.
struct BothScenes {
  std::vector<std::unique_ptr<fast::Session>> fast;
  std::vector<reference::SceneSession::Object> exact;
  std::vector<mesh::TriangleMesh> meshes;  // that paths lead over; none for a law

  void add(const MeshRendering& rendering) {
    meshes.push_back(rendering.mesh());
    fast.push_back(tests::built(fast::GodObject::build(rendering)).open());
    const auto session = std::make_shared<reference::GodObjectSession>(tests::built(reference::GodObject::build(rendering)));
    exact.emplace_back([session](const Eigen::Vector3f& p) {
      const fast::Evaluation answer = fast::evaluation_of(session->step({p.x(), p.y(), p.z()}), fast::Stage::binary64);
      return reference::Rounded{.force = answer.force, .status = answer.status};
    });
  }
  void add(LawId id) {
    const Parameters parameters{15.24F, 25.4F, 0.5F};
    meshes.push_back({{{-40, -40, 0}, {40, -40, 0}, {0, 40, 0}}, {{0, 1, 2}}});
    fast.push_back(renderer_of(tests::built(fast::Law::build(id, parameters))).open());
    exact.emplace_back([law = tests::built(reference::Law::build(id, parameters))](const Eigen::Vector3f& p) {
      return law.round_to_binary32(p);
    });
  }
};

// A law, or a mesh: shaded or not, with friction or without.
void add_random(tests::MeshSource& source, BothScenes& scenes, std::uint64_t seed) {
  if (seed % 5 == 4) return scenes.add(seed % 2 == 0 ? LawId::bump_2p : LawId::bump_cylinder);
  const tests::RandomMesh made = source.next();
  MeshRendering rendering = tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, 0.3F);
  if (seed % 2 == 0) rendering.shading = mesh::Shading::none;
  if (seed % 3 == 0) {
    rendering.contact = mesh::Contact::friction;
    rendering.materials = source.materials_of(made.mesh);
  }
  scenes.add(rendering);
}

template <class A, class B>
bool is_same(const A& a, const B& b) {
  const auto bits = [](const Eigen::Vector3f& force) {
    return std::bit_cast<std::array<std::uint32_t, 3>>(Position{force.x(), force.y(), force.z()});
  };
  return a.status == b.status && bits(a.force) == bits(b.force);
}
template <class A>
std::string show(const A& answer) {
  std::ostringstream words;
  words << "status " << static_cast<int>(answer.status) << std::hexfloat << ", " << answer.force.transpose() << " N";
  return words.str();
}

TEST(scene, is_the_reference_in_every_bit_on_random_objects_that_move) {
  const std::uint64_t count = tests::drawn(66);
  tests::MeshSource source(7);
  tests::Occasions occasions;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    BothScenes scenes;
    std::vector<tests::PosePath> motions;
    for (std::uint64_t i = 0; i <= seed % 4; ++i) {
      add_random(source, scenes, seed + i);
      motions.emplace_back(100 * seed + i);
    }
    fast::SceneSession session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
    reference::SceneSession definition(std::move(scenes.exact));
    const std::size_t felt = seed % motions.size();
    properties::MeshPath path(scenes.meshes[felt], seed);
    std::vector<scene::Pose> poses(motions.size());
    for (std::uint64_t i = 0; i < 200; ++i) {
      for (std::size_t object = 0; object < motions.size(); ++object) poses[object] = motions[object].next();
      const Eigen::Vector3f p = vector(tests::about_in_world(poses[felt], path.next()));
      const std::size_t allocated = tests::allocations();
      const fast::Evaluation found = session.step(p, poses);
      ASSERT_EQ(tests::allocations(), allocated);
      const reference::Rounded expected = definition.step(p, poses);
      ASSERT_TRUE(is_same(found, expected))
          << "scene " << seed << ", tick " << i << ": expected " << show(expected) << ", found " << show(found);
      std::size_t touching = 0;
      for (std::size_t object = 0; object < motions.size(); ++object) touching += session.of(object).status == Status::contact;
      ++occasions["status " + std::to_string(static_cast<int>(found.status))];
      occasions["several touch"] += touching > 1;
      occasions["decided in binary64"] += found.stage == fast::Stage::binary64;
      occasions["decided in wide numbers"] += found.stage == fast::Stage::wide;
    }
  }
  occasions.expect_all({"status 0", "status 1", "status 2", "several touch", "decided in binary64", "decided in wide numbers"});
}

// Exact numbers alone, and binary64 where it decides.
TEST(scene, an_object_sees_the_hand_where_the_reference_says) {
  tests::PosePath motion(3);
  std::mt19937_64 draws(4);
  tests::Occasions occasions;
  for (int i = 0; i < 20000; ++i) {
    scene::Pose pose = motion.next();
    if (!fast::is_valid(pose)) continue;
    Position p{};
    // Few bits, so that there are ties; or any.
    for (float& one : p)
      one = std::ldexp(static_cast<float>(static_cast<int>(draws() % 255) - 127), static_cast<int>(draws() % 40) - 33);
    if (draws() % 2 == 0) pose.translation = p;
    if (draws() % 2 == 0) p[draws() % 3] += 0x1p-16F;
    const Position translation = fast::quantised(pose.translation), quantised = fast::quantised(p);
    const Eigen::Vector3f expected = reference::seen_from(pose, vector(p)).value();
    const auto exact = fast::seen_from<fast::meshes::Shaded>(pose, quantised, translation);
    ASSERT_TRUE(exact.has_value());
    EXPECT_EQ(vector(fast::quantised(*exact)), expected);
    const auto filtered = fast::seen_from<fast::DoubleWithError>(pose, quantised, translation);
    ++occasions[filtered ? "decided in binary64" : "left to exact numbers"];
    if (filtered) {
      EXPECT_EQ(vector(fast::quantised(*filtered)), expected);
    }
  }
  occasions.expect_all({"decided in binary64", "left to exact numbers"});
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

// One object that is placed so, with the hand moved as it is, gives the force of the object alone, turned in the same way.
void expect_moved(std::uint64_t seed_of_meshes, const scene::Pose& pose,
                  const std::function<Position(const Position&)>& moved) {
  tests::MeshSource source(seed_of_meshes), again(seed_of_meshes);
  std::size_t touching = 0;
  for (std::uint64_t seed = 0; seed < 22; ++seed) {
    BothScenes scenes, other;
    add_random(source, scenes, seed);
    add_random(again, other, seed);
    fast::SceneSession session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
    properties::MeshPath path(scenes.meshes[0], seed);
    for (int i = 0; i < 200; ++i) {
      const Position p = path.next();
      fast::Evaluation expected = other.fast[0]->step(vector(p));
      const fast::Evaluation found = session.step(vector(moved(p)), std::array{pose});
      expected.force = vector(moved({expected.force.x(), expected.force.y(), expected.force.z()}));
      ASSERT_TRUE(is_same(found, expected)) << show(found) << ", expected " << show(expected);
      touching += found.status == Status::contact;
    }
  }
  EXPECT_GT(touching, 0U);
}

TEST(scene, of_one_object_that_is_not_moved_is_that_object_in_every_bit) {
  expect_moved(11, {{}, {0.7F, 0, 0, 0}}, [](const Position& a) { return a; });
}

// A quarter turn about z takes (x, y, z) to (-y, x, z).
TEST(scene, turned_by_a_right_angle_has_its_forces_turned_in_every_bit) {
  expect_moved(13, {{}, {0.5F, 0, 0, 0.5F}}, [](const Position& a) { return Position{0.0F - a[1], a[0], a[2]}; });
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
  fast::SceneSession session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
  const Eigen::Vector3f hand(1, 2, 0.5F);
  EXPECT_EQ(session.step(hand, std::array{scene::Pose()}).status, Status::free);
  const fast::Evaluation caught = session.step(hand, std::array{scene::Pose{{0, 0, 2}, {1, 0, 0, 0}}});
  EXPECT_EQ(caught.status, Status::contact);
  EXPECT_EQ(caught.force, Eigen::Vector3f(0, 0, 1.5F));
}

TEST(scene, a_hand_that_sticks_is_dragged_and_one_that_does_not_is_left) {
  for (const float friction : {0.0F, 1.0F}) {
    BothScenes scenes;
    scenes.add(plate(friction));
    fast::SceneSession session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
    const Eigen::Vector3f hand(0, 0, -1);
    EXPECT_EQ(session.step({0, 0, 1}, std::array{scene::Pose()}).status, Status::free);
    EXPECT_EQ(session.step(hand, std::array{scene::Pose()}).force, Eigen::Vector3f(0, 0, 1));
    const fast::Evaluation moved = session.step(hand, std::array{scene::Pose{{0.5F, 0, 0}, {1, 0, 0, 0}}});
    EXPECT_EQ(moved.force, Eigen::Vector3f(friction > 0 ? 0.5F : 0.0F, 0, 1)) << "friction " << friction;
  }
}

TEST(scene, an_invalid_pose_gives_no_force_and_keeps_the_states) {
  BothScenes scenes;
  scenes.add(plate(0));
  scenes.add(plate(0));
  fast::SceneSession session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
  const std::array poses{scene::Pose(), scene::Pose{{0, 0, -50}, {1, 0, 0, 0}}};
  EXPECT_EQ(session.step({0, 0, 1}, poses).status, Status::free);
  EXPECT_EQ(session.step({0, 0, -1}, poses).status, Status::contact);
  auto wrong = poses;
  wrong[1].rotation = {0, 0, 0, 0};
  const fast::Evaluation none = session.step({0, 0, -1}, wrong);
  EXPECT_EQ(none.status, Status::invalid);
  EXPECT_EQ(none.force, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(session.of(0).status, Status::contact) << "the other object has felt the hand";
  EXPECT_EQ(session.step({0, 0, -1}, std::span(poses).first(1)).status, Status::invalid) << "a pose is missing";
  EXPECT_EQ(session.step({0, 0, NAN}, poses).status, Status::invalid);
  EXPECT_EQ(session.step({0, 0, -2}, poses).force, Eigen::Vector3f(0, 0, 2)) << "it goes on where it was";
}

TEST(scene, reads_a_small_coordinate_as_0_in_the_world_and_in_a_pose) {
  const auto force = [](const Position& translation, float z) {
    BothScenes scenes;
    scenes.add(LawId::wall);
    return tests::built(fast::SceneSession::build(std::move(scenes.fast)))
        .step({0, 0, z}, std::array{scene::Pose{translation, {1, 0, 0, 0}}})
        .force.z();
  };
  EXPECT_EQ(force({0, 0, -0x1p-31F}, -0x1p-30F), 0x1p-31F);
  EXPECT_EQ(force({0, 0, 0x1p-30F}, -0x1p-31F), 0x1p-31F);
}

TEST(scene, is_unfinished_where_one_of_its_objects_is) {
  struct Unfinished final : fast::Session {
    fast::Evaluation step(const Eigen::Vector3f&) noexcept override {
      return {{0, 0, 1}, Status::unfinished, fast::Stage::binary64};
    }
  };
  BothScenes scenes;
  scenes.fast.push_back(std::make_unique<Unfinished>());
  scenes.add(LawId::wall);
  auto session = tests::built(fast::SceneSession::build(std::move(scenes.fast)));
  EXPECT_EQ(session.step({0, 0, 5}, std::array<scene::Pose, 2>()).status, Status::unfinished);
}

TEST(scene, has_1_to_32_objects) {
  for (const std::size_t count : {std::size_t{0}, scene::kMostObjects, scene::kMostObjects + 1}) {
    BothScenes scenes;
    for (std::size_t i = 0; i < count; ++i) scenes.add(plate(0));
    if (count == scene::kMostObjects) {
      EXPECT_EQ(tests::built(fast::SceneSession::build(std::move(scenes.fast))).size(), count);
      EXPECT_NO_THROW(reference::SceneSession{scenes.exact});
    } else {
      const auto refused = fast::SceneSession::build(std::move(scenes.fast));
      EXPECT_EQ(std::get<ParameterError>(refused).message(),
                "number of objects is " + std::to_string(count) + "; expected 1 to 32");
      EXPECT_THROW(reference::SceneSession{scenes.exact}, std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace forceshade
