// SPDX-License-Identifier: BSD-3-Clause
// Consequences of the definition of the god-object (reference/meshes/consequences.md), on random meshes and paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string_view>

#include "reference/meshes/descent.h"
#include "reference/meshes/directions.h"
#include "tests/meshes/passing.h"
#include "tests/meshes/random_paths.h"

namespace forceshade {
namespace {

using mesh::Place;
using mesh::Side;
using reference::GodObject;
using reference::meshes::Feature;
using reference::meshes::Fold;
using reference::meshes::Fraction;
using reference::meshes::Integer;
using reference::meshes::Surface;
using reference::meshes::Vector;
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

// By winding numbers, in exact predicates.
TEST(god_object_consequences, it_never_gets_into_a_closed_mesh_nor_out_of_one_that_blocks_both_sides) {
  std::mt19937_64 random(1);
  std::vector<mesh::TrianglePoints> triangles;
  std::optional<int> wound;
  for (const Friction friction : kEachFriction) {
    std::vector<std::string> expected{"kept out", "left from behind"};
    if (friction == Friction::none) expected.emplace_back("kept in");
    on_random_paths(
        7, 330, 200, expected,
        [&](const Scene& scene, const Step& step, Counts& counts) {
          constexpr std::array<std::string_view, 4> kClosed{"bipyramid", "slab", "star", "torus"};
          if (std::ranges::find(kClosed, tests::kMeshFamilies[scene.made.family]) == kClosed.end()) return;
          const auto& vertices = scene.made.mesh.vertices;
          const auto is_near = [](float x) { return std::fabs(x) <= 5000; };  // which a winding number's ray leaves
          if (!std::ranges::all_of(vertices, [&](const Position& v) { return std::ranges::all_of(v, is_near); })) return;
          if (step.before.place == Place::nowhere) {
            wound.reset();
            triangles.clear();
            for (const auto& [a, b, c] : scene.made.mesh.triangles)
              triangles.push_back({vertices[a], vertices[b], vertices[c]});
          }
          if (step.tick.status != Status::free) return;
          const std::optional<int> winds = tests::winding(triangles, step.tick.after.position, random);
          if (winds && wound) {
            const bool blocks_both = scene.made.sides == mesh::Sides::both;
            EXPECT_LE(*winds, *wound);
            EXPECT_TRUE(!blocks_both || *winds == *wound);
            counts["kept out"] += *wound == 0;
            counts["left from behind"] += *winds < *wound;
            counts["kept in"] += blocks_both && *wound > 0;
          }
          if (winds) wound = winds;
        },
        friction);
  }
}

// The squared distance of p from a closed triangle.
Fraction squared_distance(const Surface& surface, std::size_t index, const Vector& p) {
  const auto& triangle = surface.triangles()[index];
  const auto corner = [&](std::size_t i) { return p - surface.vertices()[triangle.vertices[i]]; };
  const Vector &e = triangle.sides[0], f = -triangle.sides[2], w = corner(0);
  const Integer ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), we = dot(w, e), wf = dot(w, f);
  const Integer whole = ee * ff - ef * ef, beta = we * ff - wf * ef, gamma = wf * ee - we * ef;
  if (beta >= 0 && gamma >= 0 && beta + gamma <= whole) {
    const Vector off = whole * w - beta * e - gamma * f;
    return {dot(off, off), whole * whole};
  }
  std::optional<Fraction> least;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector &side = triangle.sides[i], from = corner(i);
    const Integer length = dot(side, side), along = std::clamp(Integer(dot(from, side)), Integer(0), length);
    const Vector off = length * from - along * side;
    const Fraction distance{dot(off, off), length * length};
    if (!least || distance < *least) least = distance;
  }
  return *least;
}

TEST(god_object_consequences, every_rest_but_a_refusal_is_a_local_minimum_and_off_p_never_at_the_rim_or_on_a_wide_edge) {
  const std::vector<std::string> expected{"refused", "nearest of its triangles", "nearest on the surface alone", "narrow",
                                          "at the rim"};
  on_random_paths(8, 330, 200, expected, [](const Scene& scene, const Step& step, Counts& counts) {
    if (step.tick.status != Status::contact) return;
    const auto end = descend(scene.ground(), step.before, step.position, step.position, 256);
    const auto& rest = end.rest.value();
    const Vector p = reference::meshes::exact_point(step.position);
    const Feature& feature = rest.r.feature;
    const bool is_at_p = is_zero(rest.D_over);
    const bool is_at_rim = scene.surface.is_at_rim(feature);
    if (!is_at_p) {
      // u at r is -D, from a point with other parameters than the state's: rests at a foot are no refusals.
      const auto ways = directions(scene.surface, feature, -rest.D_over);
      const auto own =
          rest.side == Side::front ? reference::meshes::DirectionKind::front : reference::meshes::DirectionKind::back;
      if (ways.is_nearer || ways.way == own || ways.way == reference::meshes::DirectionKind::open) {
        ++counts["refused"];
        EXPECT_EQ(rest.D_under, 1) << "a refusal rests at a point of the grid";
        return;
      }
    }
    const Fraction distance{dot(rest.D_over, rest.D_over), rest.D_under * rest.D_under};
    for (const std::size_t i : scene.surface.triangles_at(feature))
      EXPECT_EQ(squared_distance(scene.surface, i, p), distance) << "triangle " << i;
    ++counts["nearest of its triangles"];
    for (std::size_t i = 0; i < scene.surface.triangles().size(); ++i)
      if (squared_distance(scene.surface, i, p) < distance) {
        ++counts["nearest on the surface alone"];
        break;
      }
    counts["at the rim"] += is_at_rim;
    EXPECT_TRUE(is_at_p || !is_at_rim) << "at the rim";
    if (feature.place != Place::edge || is_at_rim) return;
    const Fold fold = scene.surface.edges()[feature.index].fold;
    const bool is_narrow = rest.side == Side::front ? fold == Fold::narrow : fold == Fold::wide;
    counts["narrow"] += is_narrow && !is_at_p;
    EXPECT_TRUE(is_narrow || is_at_p || fold == Fold::flat);
  });
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
            if (const float its = std::fabs(moved(step.tick.force, 0)[axis]); its == 0 || its >= 0x1p-100F) {
              EXPECT_EQ(tick.force[axis], force[axis]) << show(tick);
            }
          ++counts["moved"];
          counts["of another size and touching"] += places != 0 && is_touching(tick.after);
        },
        friction);
}

}  // namespace
}  // namespace forceshade
