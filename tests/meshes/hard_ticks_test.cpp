// SPDX-License-Identifier: BSD-3-Clause
// Ticks that take many operations. Among crossing sheets, hill climbing on vertices and positions looks for them, from needles
// through a cube, plates that meet at a tiny angle, and the like; FORCESHADE_CROSSING_SEARCH=STEPS climbs for longer. And what
// docs/speed.md says of such ticks, and of vertices with many triangles.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "fast/meshes/advance.h"
#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/hard_crossings.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using tests::HardCase;
using tests::HardDraws;
using tests::kHardFamilies;
using tests::Place;

constexpr float kStiffness = 0.3F;  // N/mm
// The limits of docs/god-object.md: with the first, no detour or landing of the tick begins.
constexpr int kMostTries = 256, kMostTriesOfADetour = 256;

struct Cost {
  std::size_t operations = 0, in_binary64 = 0, in_integers = 0;
  int tries = 0, moves = 0;
  bool is_unfinished = false;
  double microseconds = 0;
};

std::optional<fast::Mesh> built(const HardCase& one, mesh::SelfIntersections allowed = mesh::SelfIntersections::allowed) {
  auto checked = mesh::check(one.mesh, allowed);
  if (!std::holds_alternative<mesh::CheckedMesh>(checked)) return std::nullopt;
  return tests::fast_mesh(
      {std::get<mesh::CheckedMesh>(std::move(checked)), {}, one.sides, mesh::Shading::none, kStiffness, {}});
}

// The cost of the tick that takes the most operations: decisions in binary64, and those in integers and tries, each of which
// takes about as long as 20 of them.
Cost cost_of(const fast::Mesh& mesh, const HardCase& one) {
  fast::Arrival at;
  Cost worst;
  for (const std::array<float, 3>& p : one.positions) {
    Cost cost;
    mesh::Tick tick;
    const auto start = std::chrono::steady_clock::now();
    fast::arrive(mesh, at, fast::quantised(p), kStiffness, mesh::Shading::none,
                 fast::CountedStages{&cost.in_binary64, &cost.in_integers}, tick);
    cost.microseconds = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    cost.tries = at.tries;
    cost.moves = at.moves;
    cost.is_unfinished = !at.is_finished;
    cost.operations = cost.in_binary64 + 20 * cost.in_integers + 20 * static_cast<std::size_t>(cost.tries);
    if (cost.operations > worst.operations) worst = cost;
  }
  return worst;
}

reference::GodObject defined(const HardCase& one, mesh::SelfIntersections allowed) {
  return tests::built(
      reference::GodObject::build({tests::checked(one.mesh, allowed), {}, one.sides, mesh::Shading::none, kStiffness, {}}));
}

// One god-object on both sides, compared at every tick.
class Both {
 public:
  explicit Both(const HardCase& one, mesh::SelfIntersections allowed = mesh::SelfIntersections::allowed)
      : mesh_(built(one, allowed).value()), definition_(defined(one, allowed)) {}

  mesh::Tick step(const std::array<float, 3>& p) {
    const mesh::Tick expected = definition_.step(p);
    const mesh::GodObject before = state_;
    state_ = expected.after;
    decisions_ = 0;
    mesh::Tick found;
    fast::arrive(mesh_, at_, fast::quantised(p), kStiffness, mesh::Shading::none, fast::CountedStages{&decisions_, &decisions_},
                 found);
    found.after = fast::object_of(mesh_, at_.spot);
    EXPECT_TRUE(tests::is_same(found, expected)) << "expected " << tests::show(expected) << ", found " << tests::show(found);
    const mesh::Tick exact = fast::step(mesh_, before, p, kStiffness, mesh::Shading::none, fast::ExactStages());
    EXPECT_TRUE(tests::is_same(exact, expected))
        << "expected " << tests::show(expected) << ", in integers " << tests::show(exact);
    return found;
  }
  int tries() const { return at_.tries; }
  std::size_t decisions() const { return decisions_; }  // of the last tick

 private:
  fast::Mesh mesh_;
  fast::Arrival at_;
  reference::GodObjectSession definition_;
  mesh::GodObject state_;
  std::size_t decisions_ = 0;
};

// The box of 10^-3 x 10^-3 x 3 of a cube's side. Its grid's steps are three thousand times as long in one direction as in
// another: beside the cube's face, a god-object that took some short ones whenever they lead nearer would use up the 256 moves
// of a tick.
TEST(hard_ticks, a_god_object_on_a_needle_through_a_cube_does_not_creep) {
  std::size_t most = 0, ticks = 0, changed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    HardDraws random(seed);
    HardCase one;
    tests::add_cube(one.mesh);
    const Place along = tests::normalised({1, random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)});
    const auto [u, v] = tests::across(random, along);
    const Place crossing{5, 5 * along[1] / along[0], 5 * along[2] / along[0]};
    tests::add_box(one.mesh, {0, 0, 0}, u, 0.005, v, 0.005, along, 15);
    Both both(one);
    const auto near_crossing = [&](double x) {
      return tests::at(crossing, {1, 0, 0}, x, {0, 1, 0}, random.uniform(-0.01, 0.01), {0, 0, 1}, random.uniform(-0.01, 0.01));
    };
    for (const std::array<float, 3>& p : {std::array{50.0F, 60.0F, 70.0F}, near_crossing(0.02), near_crossing(-0.02),
                                          near_crossing(0.001), near_crossing(-0.001), near_crossing(-0.005)}) {
      const mesh::Tick tick = both.step(p), again = both.step(p);
      most = std::max<std::size_t>(most, tick.moves);
      ++ticks;
      EXPECT_NE(tick.status, Status::unfinished) << "seed " << seed;
      EXPECT_EQ(again.after, tick.after) << "seed " << seed;
      changed += tick.status == Status::contact;
    }
  }
  std::printf("  %zu ticks, %zu in contact, at most %zu moves\n", ticks, changed, most);
  EXPECT_GT(changed, ticks / 4);
  EXPECT_LE(most, 16U);
}

// Found by the search: three plates, between two of which there are but few points of the grid.
TEST(hard_ticks, a_tick_without_tries_is_unfinished_and_the_next_one_goes_on) {
  HardCase one;
  one.sides = Sides::both;
  one.mesh.vertices = {{8.23545647F, -4.80977011F, 4.41627359F},
                       {-5, -3, 9},
                       {-8.36256218F, 4.70150852F, -4.46954155F},
                       {4.62033796F, 2.64553428F, -9.08213329F},
                       {1.55420613F, 1.5917691F, -10.1907721F},
                       {1.48728883F, 3.23614883F, 9.74090385F},
                       {-1.68131196F, -1.70003533F, 10.1375046F},
                       {-2, -3, -10},
                       {-7, 1, -16},
                       {7, -4, -15},
                       {7, -1, 16},
                       {-7, 4, 15}};
  for (std::uint32_t first = 0; first < 12; first += 4) {
    one.mesh.triangles.push_back({first, first + 1, first + 2});
    one.mesh.triangles.push_back({first, first + 2, first + 3});
  }
  Both both(one);
  for (const std::array<float, 3>& p :
       {std::array{50.0F, 60.0F, 70.0F}, {-1.0F, -2.0F, -5.0F}, {-3.29070997F, -2.74937701F, -4.73281002F}})
    both.step(p);
  const std::array<float, 3> held{-3.28553295F, -2.74942589F, -4.73269796F};
  const mesh::Tick first = both.step(held);
  EXPECT_EQ(first.status, Status::unfinished);
  EXPECT_LT(first.moves, 256);
  EXPECT_GE(both.tries(), kMostTries);
  const mesh::Tick second = both.step(held);
  EXPECT_EQ(second.status, Status::contact);
  EXPECT_GT(second.moves, 0);
  EXPECT_EQ(both.step(held).after, second.after);
}

// Two vertices of nine triangles, one on an edge of the other, a step beside it: 64 pairs of triangles.
TEST(hard_ticks, a_detour_has_only_so_many_tries) {
  HardCase one;
  one.sides = Sides::both;
  one.mesh.vertices = {{0, 0, 0},
                       {-4.76691484F, 3.64369631F, 0.195725769F},
                       {-5.99379158F, -0.272880375F, 0.254443496F},
                       {-4.4161067F, -4.0617733F, 0.313161224F},
                       {-0.772076249F, -5.95011759F, 0.195725769F},
                       {3.233217F, -5.05433559F, 0.254443496F},
                       {5.72565222F, -1.79357374F, 0.313161224F},
                       {5.53899097F, 2.30642104F, 0.195725769F},
                       {2.76057434F, 5.32721567F, 0.254443496F},
                       {-1.30954564F, 5.85534716F, 0.313161224F},
                       {-0.000753980712F, -0.00581066171F, 0.000191138446F},
                       {-4.41808319F, -4.05843258F, 0.255348563F},
                       {-5.99479961F, -0.278148234F, -0.0061158333F},
                       {-4.76715374F, 3.63121819F, -0.239971593F},
                       {-1.30917752F, 5.83836746F, -0.367587388F},
                       {2.76030803F, 5.31467628F, -0.267665595F},
                       {5.53754282F, 2.30312204F, -0.0177531224F},
                       {5.72342682F, -1.78921831F, 0.234420836F},
                       {3.23018575F, -5.04336691F, 0.432446033F},
                       {-0.77516669F, -5.93873501F, 0.452871889F}};
  for (std::uint32_t apex : {0U, 10U})
    for (std::uint32_t i = 0; i < 9; ++i) one.mesh.triangles.push_back({apex, apex + 1 + i, apex + 1 + (i + 1) % 9});
  Both both(one);
  both.step({0, 0, 0});
  both.step({-0.775932133F, -5.9364686F, -0.751537442F});
  EXPECT_EQ(both.tries(), kMostTriesOfADetour);
}

// n triangles around the origin, which is a vertex; their other corners lie 50 mm off it, at heights up to 5 mm.
HardCase fan(std::uint32_t n, Sides sides) {
  HardCase one;
  one.sides = sides;
  one.mesh.vertices.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    one.mesh.vertices.push_back({static_cast<float>(50 * std::cos(angle)), static_cast<float>(50 * std::sin(angle)),
                                 static_cast<float>(0.05 * (7919 * i % 100))});
    one.mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return one;
}

// Each triangle at a vertex meets a flight or a way through it, and to find how the vertex lies to it looks at each of them.
TEST(hard_ticks, a_tick_at_a_vertex_of_many_triangles_looks_at_each_of_them_but_a_few_times) {
  constexpr std::uint32_t kTriangles = 200;
  std::size_t most = 0, ticks = 0;
  for (const Sides sides : {Sides::front, Sides::both})
    for (const auto allowed : {mesh::SelfIntersections::refused, mesh::SelfIntersections::allowed})
      for (const float from : {3.0F, -3.0F})
        for (const std::array<float, 3>& to : {std::array{0.0F, 0.0F, -from}, {0.0F, 0.0F, 0.0F}, {0.1F, -0.2F, -from}}) {
          Both both(fan(kTriangles, sides), allowed);
          for (const std::array<float, 3>& p : {std::array{-to[0], -to[1], from}, to, std::array{0.3F, 0.1F, -from}}) {
            both.step(p);
            most = std::max(most, both.decisions());
            ++ticks;
          }
        }
  std::printf("  %zu ticks, at most %zu decisions for %u triangles\n", ticks, most, kTriangles);
  EXPECT_LE(most, 12 * kTriangles);
}

std::size_t steps_of_the_search() {
  const char* given = std::getenv("FORCESHADE_CROSSING_SEARCH");
  return given == nullptr ? 1500 : std::strtoull(given, nullptr, 10);
}

// From a drawn mesh and path, whatever costs more, as long as there is some within 60 tries.
struct Climb {
  Cost cost;
  HardCase one;
  std::size_t meshes = 0, unfinished = 0;

  Climb(std::size_t family, std::uint64_t seed) {
    HardDraws random(seed);
    for (std::size_t step = 0, idle = 0; step < 300 && idle < 60; ++step, ++idle) {
      HardCase next = one;
      if (one.mesh.triangles.empty()) {
        next = tests::drawn_hard_case(family, random);
      } else {
        next = tests::nudged(std::move(next), random);
      }
      const auto mesh = built(next);
      if (!mesh) continue;
      ++meshes;
      const Cost found = cost_of(*mesh, next);
      unfinished += found.is_unfinished;
      if (found.operations < cost.operations) continue;
      if (found.operations > cost.operations) idle = 0;
      cost = found;
      one = std::move(next);
    }
  }
};

// Expects that both sides agree along the path, and that a position that is held comes to rest, unless it finds no place to
// land on. Returns the most ticks that this takes.
int expect_right(const HardCase& one, const char* family) {
  constexpr int kMostTicks = 32;
  int most = 0;
  Both both(one);
  for (const std::array<float, 3>& p : one.positions) {
    mesh::Tick last = both.step(p);
    EXPECT_LT(both.tries(), kMostTries + kMostTriesOfADetour);
    mesh::Tick again = both.step(p);
    int ticks = 1;
    for (; again.after != last.after && ticks < kMostTicks; ++ticks) last = again, again = both.step(p);
    EXPECT_EQ(again.after, last.after) << family;
    most = std::max(most, ticks);
  }
  return most;
}

TEST(hard_ticks, the_worst_ticks_that_hill_climbing_finds_are_within_the_bounds_and_right) {
  const std::size_t climbs = steps_of_the_search() / 100;
  for (std::size_t family = 0; family < kHardFamilies.size(); ++family) {
    Climb worst(family, 1000000 * family);
    std::size_t meshes = worst.meshes, unfinished = worst.unfinished;
    int ticks = expect_right(worst.one, kHardFamilies[family]);
    for (std::uint64_t climb = 1; climb < climbs; ++climb) {
      Climb next(family, 1000000 * family + climb);
      meshes += next.meshes;
      unfinished += next.unfinished;
      ticks = std::max(ticks, expect_right(next.one, kHardFamilies[family]));
      if (next.cost.operations > worst.cost.operations) worst = std::move(next);
    }
    Cost cost = worst.cost;
    // Other programs interrupt some.
    for (int pass = 0; pass < 5; ++pass)
      cost.microseconds = std::min(cost.microseconds, cost_of(built(worst.one).value(), worst.one).microseconds);
    std::printf(
        "  %-30s %7zu meshes, %zu unfinished; at worst %d tries, %d moves, %zu decisions in binary64, %zu in integers%s, %.0f "
        "us; %d ticks to rest\n",
        kHardFamilies[family], meshes, unfinished, cost.tries, cost.moves, cost.in_binary64, cost.in_integers,
        cost.is_unfinished ? ", unfinished" : "", cost.microseconds, ticks);
    EXPECT_GT(cost.tries, 0) << kHardFamilies[family];
  }
}

}  // namespace
}  // namespace forceshade
