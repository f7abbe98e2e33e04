// SPDX-License-Identifier: BSD-3-Clause
// Damping behind renderers of every kind: laws, height maps, meshes, friction, any set of triangles, and scenes of objects that
// move, whose damping takes the hand's own position; with materials that limit it. FORCESHADE_DRAWS=N draws more paths, from
// number FORCESHADE_FIRST on.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/damped.h"
#include "forceshade/meshes.h"
#include "forceshade/properties.h"
#include "tests/damping/both_sides.h"
#include "tests/meshes/uncut.h"
#include "tests/scenes/random_scene.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

constexpr std::array<const char*, 6> kKinds{"law",         "height map", "mesh", "mesh with friction", "set of triangles",
                                            "moving scene"};
constexpr std::size_t kTicks = 1000, kExactTicks = 50;

Description random_map(std::uint64_t seed) {
  HeightMap map;
  map.parts.push_back({height::Plane{0.125F, -0.25F, 0}});
  if (seed % 2 == 0) map.parts.push_back({height::Gaussian{.height = 3, .sigma = 5}});
  return {"map.toml", DescribedHeightMap{map, height::kModes[seed % height::kModes.size()].mode, 0.5F}};
}

// Gives each triangle one of four limits beside its friction, of the sizes of Hand::parameters().
void limit(MeshRendering& rendering, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const mesh::Materials before = std::exchange(rendering.materials, {});
  const auto number = [&] { return std::array<float, 6>{HUGE_VALF, 0, 0x1p-20F, 0.0007F, 0x1p-11F, 0.05F}[random() % 6]; };
  for (std::size_t i = 0; i < std::max<std::size_t>(before.list.size(), 1); ++i)
    for (int limits = 0; limits < 4; ++limits) {
      mesh::Material its = before.list.empty() ? mesh::Material{} : before.list[i];
      its.damping = limits == 0 ? damping::Limits{0, 0} : damping::Limits{number(), number()};
      rendering.materials.list.push_back(its);
    }
  for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i)
    rendering.materials.of_triangle.push_back((before.of_triangle.empty() ? 0 : 4 * before.of_triangle[i]) +
                                              static_cast<std::uint32_t>(random() % 4));
}

// A tetrahedron whose faces stand in another one's, and one face twice.
Description crossing_faces(std::uint64_t seed) {
  const float x = 0.25F * static_cast<float>(seed % 8);
  MeshRendering its{.checked = std::get<mesh::CheckedMesh>(
                        mesh::check_any({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {x, 1, -1}, {x, 4, 1}, {x, 1, 3}},
                                         {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {4, 5, 6}, {1, 2, 3}}})),
                    .sides = mesh::Sides::both,
                    .stiffness = 0.5F};
  if (seed % 3 != 0) return {"its.off", its};
  its.contact = mesh::Contact::friction;
  its.materials.list.push_back({{}, 0.5F, 0.25F});
  return {"its.off", its};
}

// Every second one has limits.
Description subject_of_kind(std::size_t kind, std::uint64_t seed, tests::MeshSource& source) {
  if (kind == 0) return tests::law(kLaws[seed % kLaws.size()].id);
  if (kind == 1) return random_map(seed);
  Description its = kind == 5   ? Description{"scene.toml", tests::random_scene(source, seed)}
                    : kind == 4 ? crossing_faces(seed)
                                : tests::random_mesh(source, kind == 3);
  if (seed % 2 == 0) return its;
  if (auto* scene = std::get_if<DescribedScene>(&its.what)) {
    for (MovingObject& one : scene->objects)
      if (auto* mesh = std::get_if<MeshRendering>(&one.what.what)) limit(*mesh, ++seed);
  } else {
    limit(std::get<MeshRendering>(its.what), seed);
  }
  return its;
}

// A hand that jumps, moves in counts of an encoder, rests, and is lost now and then.
class Hand {
 public:
  Hand(const properties::Subject& subject, std::uint64_t seed) : random_(seed), positions_(subject.positions(seed)) {}

  bool once_in(std::uint64_t n) { return random_() % n == 0; }
  std::uint32_t periods() { return once_in(8) ? static_cast<std::uint32_t>(random_() % 20) : 1; }
  Eigen::Vector3f next() {
    if (once_in(100)) return {NAN, 0, 0};
    if (once_in(30)) at_ = positions_->next().position;
    if (!once_in(4))
      for (float& x : at_) x += 0.03125F * static_cast<float>(static_cast<int>(random_() % 5) - 2);
    return at_;
  }
  damping::Parameters parameters() {
    const auto one_of = [&](auto... numbers) {
      return std::array<float, sizeof...(numbers)>{numbers...}[random_() % sizeof...(numbers)];
    };
    return {.rate = one_of(1000.0F, 200.0F, 999.9F, 4096.0F),
            .share = one_of(1.0F, 0.5F, 0.3F, 0x1p-10F),
            .damping = one_of(0.002F, 0x1p-9F, 0.1F, 0x1p-20F),
            .most = one_of(2.0F, 1.0F, 1.7F, INFINITY),
            .drag = one_of(0.0F, 0.001F, 0x1p-10F, 1.0F),
            .full_at = one_of(0.25F, 0.1F)};
  }

 private:
  std::mt19937_64 random_;
  std::unique_ptr<properties::Positions> positions_;
  Eigen::Vector3f at_{0, 0, 0};
};

// One path: its damped session against the definition behind the forces of an undamped one, whose first ones are exact, too;
// and the same path as a batch.
void follow(const properties::Subject& subject, std::uint64_t seed, bool is_scene,
            std::map<std::string, std::size_t>& reached) {
  Hand hand(subject, seed);
  const damping::Parameters parameters = hand.parameters();
  tests::DampingOfBothSides both(parameters);
  auto batch_damping = both.fast;
  fast::DampedSession session(subject.renderer().open(), both.fast);
  const auto bare = subject.renderer().open();
  const auto exact = subject.open_reference();
  std::vector<Eigen::Vector3f> positions, batch, damped;
  std::vector<std::uint32_t> periods;
  bool has_limits = false;
  for (std::size_t tick = 0; tick < kTicks && !testing::Test::HasFailure(); ++tick) {
    const Eigen::Vector3f& position = positions.emplace_back(hand.next());
    const std::uint32_t since = periods.emplace_back(hand.periods());
    const fast::Evaluation spring = bare->step(position), found = session.step_after(since, position);
    if (tick < kExactTicks) {
      const reference::Rounded right = exact->step(position);
      EXPECT_TRUE(tests::same_bits(right.force, spring.force));
      EXPECT_TRUE(spring.status == Status::invalid || right.damping == spring.damping) << "tick " << tick;
    }
    const fast::Evaluation expected = both.tick(position, since, spring.force, spring.status, spring.damping);
    const bool is_limited = spring.damping.damping < parameters.damping || spring.damping.drag < parameters.drag;
    has_limits |= is_limited;
    EXPECT_TRUE(tests::same_bits(found.force, expected.force) && found.status == expected.status) << "tick " << tick;
    EXPECT_EQ(session.damping().state(), both.reference.state());
    batch.push_back(spring.force);
    damped.push_back(found.force);
    ++reached["ticks"];
    reached["forces that are damped"] += found.force != spring.force;
    reached["forces that are let go"] += spring.force != found.force && found.force.isZero(0);
    reached["invalid ticks"] += found.status == Status::invalid;
    reached["ticks with missed positions"] += since > 1;
    reached["forces that a face damps less"] += is_limited && found.force != spring.force;
    reached["forces that a face does not damp"] += spring.damping == damping::Limits{0, 0} && found.force == spring.force;
  }
  if (is_scene || has_limits) return;  // of whose invalid poses and limits a batch of forces does not know
  fast::damp(batch_damping, positions, batch, periods);
  for (std::size_t tick = 0; tick < batch.size(); ++tick) EXPECT_TRUE(tests::same_bits(batch[tick], damped[tick])) << tick;
  EXPECT_EQ(batch_damping.state(), both.fast.state());
}

TEST(damped_renderers, are_the_definition_in_every_bit) {
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    tests::MeshSource source(kind + tests::first_drawn());
    std::map<std::string, std::size_t> reached;
    const std::uint64_t first = tests::first_drawn(), end = first + tests::drawn(40);
    for (std::uint64_t seed = first; seed < end && !HasFailure(); ++seed) {
      const auto subject = properties::subject_of(subject_of_kind(kind, seed, source));
      follow(*subject, seed, kind == 5, reached);
      EXPECT_FALSE(HasFailure()) << kKinds[kind] << ", path " << seed;
    }
    for (const char* event :
         {"ticks", "forces that are damped", "forces that are let go", "invalid ticks", "ticks with missed positions"}) {
      std::printf("%9zu %s of a %s\n", reached[event], event, kKinds[kind]);
      EXPECT_GT(reached[event], 0U) << event << " of a " << kKinds[kind];
    }
    for (const char* event : {"forces that a face damps less", "forces that a face does not damp"}) {
      std::printf("%9zu %s of a %s\n", reached[event], event, kKinds[kind]);
      EXPECT_EQ(reached[event] > 0, kind > 1) << event << " of a " << kKinds[kind];
    }
  }
}

// Two faces, of which one lets half of B act and the other one all of it, as does the edge between them.
TEST(damped_renderers, damp_each_face_as_its_material_lets_them) {
  MeshRendering roof{.checked = std::get<mesh::CheckedMesh>(
                         mesh::check({{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}})),
                     .stiffness = 0.5F,
                     .materials = {{{.damping = {0x1p-13F, HUGE_VALF}}, {}}, {0, 1}}};
  const auto pressed_at = [&](float x, float y) {
    const auto built = fast::GodObject::build(roof);
    fast::DampedSession session(std::get<fast::GodObject>(built).open(),
                                std::get<fast::Damping>(fast::Damping::build({.rate = 1024, .damping = 0x1p-12F})));
    session.step({x, y, 0.125F});
    return session.step({x, y, -0.5F}).force;  // at 640 mm/s; the spring's is 0.25 N
  };
  EXPECT_EQ(pressed_at(2, 1), Eigen::Vector3f(0, 0, 0.328125F));
  EXPECT_EQ(pressed_at(1, 2), Eigen::Vector3f(0, 0, 0.40625F));
  EXPECT_EQ(pressed_at(1, 1), Eigen::Vector3f(0, 0, 0.40625F)) << "on the edge";
  roof.materials.list[1].damping.damping = 0;
  EXPECT_EQ(pressed_at(1, 2), Eigen::Vector3f(0, 0, 0.25F)) << "not damped at all";
  EXPECT_EQ(pressed_at(1, 1), Eigen::Vector3f(0, 0, 0.328125F));
}

// Answers with limits.
class Pressing final : public fast::Session {
 public:
  explicit Pressing(const fast::Evaluation& answer) : answer_(answer) {}
  fast::Evaluation step(const Eigen::Vector3f&) noexcept override { return answer_; }

 private:
  fast::Evaluation answer_;
};

TEST(damped_renderers, of_scenes_have_the_largest_limits_of_the_objects_that_are_touched) {
  const fast::Evaluation one{{0, 0, 1}, Status::contact, {}, {3, 1}}, other{{0, 0, 1}, Status::unfinished, {}, {2, 4}},
      away{{0, 0, 0}, Status::free, {}, {}};
  const std::array<scene::Pose, 3> poses{};
  const auto limits_of = [&](std::array<fast::Evaluation, 3> answers) {
    std::vector<std::unique_ptr<fast::Session>> objects;
    std::vector<reference::SceneSession::Object> exact;
    for (const fast::Evaluation& its : answers) {
      objects.push_back(std::make_unique<Pressing>(its));
      exact.push_back([its](const Eigen::Vector3f&) {
        reference::Rounded answer{.force = its.force, .status = its.status};
        answer.damping = its.damping;
        return answer;
      });
    }
    auto scene = std::get<fast::SceneSession>(fast::SceneSession::build(std::move(objects)));
    const damping::Limits found = scene.step({0, 0, 0}, poses).damping;
    EXPECT_EQ(found, reference::SceneSession(exact).step({0, 0, 0}, poses).damping);
    return found;
  };
  EXPECT_EQ(limits_of({one, other, away}), (damping::Limits{3, 4}));
  EXPECT_EQ(limits_of({away, other, one}), (damping::Limits{3, 4}));
  EXPECT_EQ(limits_of({away, one, away}), (damping::Limits{3, 1}));
  EXPECT_EQ(limits_of({away, away, away}), damping::Limits{});
}

// Another's renderer may give any numbers as limits: what is no B counts as 0, and what is no number as no limit.
TEST(damped_renderers, take_any_number_as_a_limit) {
  for (const auto& [limit, force] :
       {std::pair{-1.0F, 0.25F}, {0x1p-21F, 0.25F}, {NAN, 0.375F}, {100, 0.375F}, {0x1p-12F, 0.3125F}}) {
    tests::DampingOfBothSides both({.rate = 1024, .damping = 0x1p-11F});
    both.tick({0, 0, 0}, 1, {0, 0, 0.25F});
    const fast::Evaluation found = both.tick({0, 0, -0.25F}, 1, {0, 0, 0.25F}, Status::contact, {limit, limit});
    EXPECT_EQ(found.force, Eigen::Vector3f(0, 0, force)) << limit;
  }
}

// As many as the shorter span has; where there are no periods, they are 1.
TEST(damped_renderers, of_batches_are_as_long_as_the_shorter_span) {
  auto damping = std::get<fast::Damping>(fast::Damping::build({.rate = 1000, .damping = 1}));
  const Eigen::Vector3f one(0, 0, 1), none(0, 0, 0);
  const std::array<Eigen::Vector3f, 5> positions{none, {0, 2e4F, 0}, {0, -2e4F, 0}, {0, 0, -3}, none};
  std::array<Eigen::Vector3f, 4> forces{one, one, one, one};
  const std::array<std::uint32_t, 1> periods{5};
  EXPECT_EQ(fast::damp(damping, positions, forces, periods).invalid, 2U);
  EXPECT_EQ(forces, (std::array<Eigen::Vector3f, 4>{one, none, none, {0, 0, 2}}));
  EXPECT_EQ(damping.state(), (damping::State{true, {0, 0, -3}, {0, 0, -1000}, 0}));
  forces.fill(one);
  EXPECT_EQ(fast::damp(damping, std::span(positions).first(1), forces).invalid, 0U);
  EXPECT_EQ(forces, (std::array<Eigen::Vector3f, 4>{none, one, one, one}));
}

}  // namespace
}  // namespace forceshade
