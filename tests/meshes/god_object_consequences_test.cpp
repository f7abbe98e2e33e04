// SPDX-License-Identifier: BSD-3-Clause
// Consequences of the definition of the god-object (reference/meshes/consequences.md), on random meshes and paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "tests/meshes/random_paths.h"

namespace forceshade {
namespace {

using mesh::Place;
using reference::GodObject;
using tests::built;
using tests::Counts;
using tests::Friction;
using tests::is_touching;
using tests::kEachFriction;
using tests::on_random_paths;
using tests::Position;
using tests::Scene;
using tests::show;
using tests::squared_distance;
using tests::Step;

TEST(god_object_consequences, resting_is_idempotent) {
  for (const Friction friction : kEachFriction)
    on_random_paths(
        1, 220, 200, {"rested again"},
        [](const Scene& scene, const Step& step, Counts& counts) {
          if (step.tick.status == Status::unfinished || step.tick.status == Status::invalid) return;
          const mesh::Tick again = scene.god_object.step(step.tick.after, step.position);
          EXPECT_EQ(again.status, step.tick.status) << show(again);
          EXPECT_EQ(again.after, step.tick.after) << show(again);
          EXPECT_EQ(again.force, step.tick.force) << show(again);
          ++counts["rested again"];
        },
        friction);
}

TEST(god_object_consequences, an_invalid_position_changes_nothing_and_gives_no_force) {
  on_random_paths(2, 110, 100, {"invalid while touching"}, [](const Scene&, const Step& step, Counts& counts) {
    if (step.tick.status != Status::invalid) return;
    EXPECT_EQ(step.tick.after, step.before);
    EXPECT_EQ(step.tick.force, (Position{0, 0, 0}));
    counts["invalid while touching"] += is_touching(step.before);
  });
}

// One move a tick: so every point at which the surface is left or met again is a state.
TEST(god_object_consequences, fewer_moves_a_tick_lead_to_the_same_state_and_from_point_to_point_the_distance_falls) {
  for (const Friction friction : kEachFriction)
    on_random_paths(
        3, 220, 150, {"several moves", "landed farther off"},
        [](const Scene& scene, const Step& step, Counts& counts) {
          if (step.tick.status == Status::invalid || step.tick.status == Status::unfinished) return;
          mesh::GodObject state = step.before;
          unsigned moves = 0;
          for (int ticks = 0; ticks <= 300; ++ticks) {
            const mesh::Tick one = scene.god_object.step(state, step.position, 1);
            moves += one.moves;
            if (one.status != Status::unfinished) {
              EXPECT_EQ(one.after, step.tick.after) << show(one);
              EXPECT_EQ(one.force, step.tick.force) << show(one);
              EXPECT_EQ(moves, step.tick.moves);
              counts["several moves"] += moves > 1;
              return;
            }
            const bool is_nearer = squared_distance(scene.surface, one.after, step.position) <
                                   squared_distance(scene.surface, state, step.position);
            if (is_touching(state))
              ASSERT_TRUE(is_nearer) << show(one);
            else
              counts["landed farther off"] += !is_nearer;
            state = one.after;
          }
          FAIL() << "not at rest after 300 single moves";
        },
        friction);
}

// Returns true if each coordinate times 2^places is exact and a coordinate too.
bool can_be_scaled(const Position& position, int places) {
  return std::ranges::all_of(position, [&](float x) {
    const float scaled = std::ldexp(x, places);
    return std::fabs(x) <= 1e4F && (x == 0 || (std::fabs(x) >= 0x1p-30F && std::fabs(scaled) >= 0x1p-30F)) &&
           std::fabs(scaled) <= 1e4F && std::ldexp(scaled, -places) == x;
  });
}

// Times 2^places, and turned by a quarter about z; 0 has no sign in what a mesh is made of.
Position moved(const Position& v, int places) {
  return {0.0F - std::ldexp(v[1], places), std::ldexp(v[0], places), std::ldexp(v[2], places)};
}

TEST(god_object_consequences, a_quarter_turn_and_a_size_times_a_power_of_two_change_no_state) {
  std::mt19937_64 random(4);
  int places = 0;
  std::optional<GodObject> other;
  for (const Friction friction : kEachFriction)
    on_random_paths(
        4, 220, 150, {"moved", "of another size and touching"},
        [&](const Scene& scene, const Step& step, Counts& counts) {
          if (step.before.place == Place::nowhere) {
            const auto fits = [&](const Position& v) { return can_be_scaled(v, places); };
            do {
              places = static_cast<int>(random() % 33) - 16;
            } while (!std::ranges::all_of(scene.made.mesh.vertices, fits));
            mesh::TriangleMesh mesh = scene.made.mesh;
            for (mesh::Vertex& vertex : mesh.vertices) vertex = moved(vertex, places);
            mesh::CornerNormals normals = scene.normals;
            for (auto& corners : normals)
              for (mesh::Normal& normal : corners) normal = moved(normal, 0);
            other = built(mesh, normals, scene.made.sides, Scene::kStiffness, scene.given);
          }
          const bool is_free = step.before.place == Place::free;
          if (!can_be_scaled(step.position, places) || (is_free && !can_be_scaled(step.before.position, places))) return;
          mesh::GodObject before = step.before, after = step.tick.after;
          before.position = moved(before.position, places);
          after.position = moved(after.position, places);
          const mesh::Tick tick = other->step(before, moved(step.position, places));
          const Position force = moved(step.tick.force, places);
          EXPECT_EQ(tick.status, step.tick.status) << show(tick);
          EXPECT_EQ(tick.moves, step.tick.moves) << show(tick);
          EXPECT_EQ(tick.after, after) << show(tick);
          for (std::size_t axis = 0; axis < 3; ++axis)  // below 2^-126 a component has fewer digits
            if (std::fabs(moved(step.tick.force, 0)[axis]) >= 0x1p-100F) {
              EXPECT_EQ(tick.force[axis], force[axis]) << show(tick);
            }
          ++counts["moved"];
          counts["of another size and touching"] += places != 0 && is_touching(tick.after);
        },
        friction);
}

}  // namespace
}  // namespace forceshade
