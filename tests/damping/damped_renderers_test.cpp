// SPDX-License-Identifier: BSD-3-Clause
// Damping behind renderers of every kind: laws, height maps, meshes, friction, and scenes of objects that move, whose damping
// takes the hand's own position. FORCESHADE_DRAWS=N draws more paths.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "forceshade/damped.h"
#include "forceshade/properties.h"
#include "tests/damping/both_sides.h"
#include "tests/scenes/random_scene.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

constexpr std::array<const char*, 5> kKinds{"law", "height map", "mesh", "mesh with friction", "moving scene"};
constexpr std::size_t kTicks = 1000, kExactTicks = 50;

Description random_map(std::uint64_t seed) {
  HeightMap map;
  map.parts.push_back({height::Plane{0.125F, -0.25F, 0}});
  if (seed % 2 == 0) map.parts.push_back({height::Gaussian{.height = 3, .sigma = 5}});
  return {"map.toml", DescribedHeightMap{map, height::kModes[seed % height::kModes.size()].mode, 0.5F}};
}

Description subject_of_kind(std::size_t kind, std::uint64_t seed, properties::MeshSource& source) {
  if (kind == 0) return tests::law(kLaws[seed % kLaws.size()].id);
  if (kind == 1) return random_map(seed);
  if (kind < 4) return tests::random_mesh(source, kind == 3);
  return {"scene.toml", tests::random_scene(source, seed)};
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
  for (std::size_t tick = 0; tick < kTicks && !testing::Test::HasFailure(); ++tick) {
    const Eigen::Vector3f& position = positions.emplace_back(hand.next());
    const std::uint32_t since = periods.emplace_back(hand.periods());
    const fast::Evaluation spring = bare->step(position), found = session.step_after(since, position);
    if (tick < kExactTicks) {
      EXPECT_TRUE(tests::same_bits(exact->step(position).force, spring.force));
    }
    const fast::Evaluation expected = both.tick(position, since, spring.force, spring.status);
    EXPECT_TRUE(tests::same_bits(found.force, expected.force) && found.status == expected.status) << "tick " << tick;
    EXPECT_EQ(session.damping().state(), both.reference.state());
    batch.push_back(spring.force);
    damped.push_back(found.force);
    ++reached["ticks"];
    reached["forces that are damped"] += found.force != spring.force;
    reached["forces that are let go"] += spring.force != found.force && found.force.isZero(0);
    reached["invalid ticks"] += found.status == Status::invalid;
    reached["ticks with missed positions"] += since > 1;
  }
  if (is_scene) return;  // whose invalid poses a batch of forces does not show
  fast::damp(batch_damping, positions, batch, periods);
  for (std::size_t tick = 0; tick < batch.size(); ++tick) EXPECT_TRUE(tests::same_bits(batch[tick], damped[tick])) << tick;
  EXPECT_EQ(batch_damping.state(), both.fast.state());
}

TEST(damped_renderers, are_the_definition_in_every_bit) {
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    properties::MeshSource source(kind);
    std::map<std::string, std::size_t> reached;
    const std::size_t paths = tests::drawn(40);
    for (std::uint64_t seed = 0; seed < paths && !HasFailure(); ++seed) {
      const auto subject = properties::subject_of(subject_of_kind(kind, seed, source));
      follow(*subject, seed, kind == 4, reached);
      EXPECT_FALSE(HasFailure()) << kKinds[kind] << ", path " << seed;
    }
    for (const char* event :
         {"ticks", "forces that are damped", "forces that are let go", "invalid ticks", "ticks with missed positions"}) {
      std::printf("%9zu %s of a %s\n", reached[event], event, kKinds[kind]);
      EXPECT_GT(reached[event], 0U) << event << " of a " << kKinds[kind];
    }
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
