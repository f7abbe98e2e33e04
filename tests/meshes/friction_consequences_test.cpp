// SPDX-License-Identifier: BSD-3-Clause
// The consequences of the definition of friction (docs/friction.md, Consequences): the cone on random meshes and paths, and
// what a floor and a roof do exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/meshes/directions.h"
#include "tests/meshes/random_paths.h"

namespace forceshade {
namespace {

using mesh::Place;
using reference::GodObjectSession;
using reference::meshes::Feature;
using reference::meshes::Integer;
using reference::meshes::kGrid;
using reference::meshes::Load;
using reference::meshes::Surface;
using reference::meshes::Vector;
using tests::Counts;
using tests::Position;
using tests::Scene;
using tests::Step;

// The square of the longest step of the feature's grid, times 4^24.
Integer longest_step_squared(const Surface& surface, const Feature& feature) {
  if (feature.place == Place::edge) return surface.edges()[feature.index].length_squared;
  const auto& sides = surface.triangles()[feature.index].sides;
  return std::max({dot(sides[0], sides[0]), dot(sides[1], sides[1]), dot(sides[2], sides[2])});
}

// Returns true if λt² <= h²/3, as of a refused slide that ends inside its feature.
bool is_within_a_step(const Load& load, const Integer& share, const Integer& step_squared) {
  return 3 * share * kGrid * dot(load.pull, load.pull) <= step_squared * load.under * load.under;
}

TEST(friction_consequences, a_rest_at_a_rough_place_is_the_state_and_inside_the_cone_or_refused) {
  const std::vector<std::string> expected{"held", "held while it slips", "refused", "without pull"};
  tests::on_random_paths(
      21, 330, 200, expected,
      [](const Scene& scene, const Step& step, Counts& counts) {
        const mesh::GodObject& after = step.tick.after;
        if (step.tick.status != Status::contact) return;
        const auto at = tests::point_of(scene.surface, after);
        if (!scene.materials.is_rough(at.feature)) {
          EXPECT_FALSE(after.is_slipping);
          return;
        }
        const auto end = descend(scene.ground(), step.before, step.position, step.position, 256);
        const auto& rest = end.rest.value();
        const Vector g = scene.surface.position(at), u = reference::meshes::exact_point(step.position) - g;
        EXPECT_EQ(rest.D_over + rest.tangential_over, -(rest.D_under * u));
        const auto ways = is_zero(u) ? reference::meshes::Directions{} : directions(scene.surface, at.feature, u);
        if (!ways.is_nearer) {
          EXPECT_TRUE(is_zero(rest.tangential_over));
          EXPECT_FALSE(after.is_slipping);
          ++counts["without pull"];
          return;
        }
        const mesh::Material its = scene.materials.of(ways.along);
        const Load load = load_on(scene.surface, ways.along, u);
        EXPECT_EQ(rest.tangential_over, its.static_friction > 0 ? -load.pull : Vector{});
        if (is_within(load, after.is_slipping ? its.dynamic_friction : its.static_friction)) {
          ++counts[after.is_slipping ? "held while it slips" : "held"];
          EXPECT_EQ(dot(rest.D_over, rest.tangential_over), 0);
          return;
        }
        ++counts["refused"];
        const Integer of_way = share(load, its.dynamic_friction);
        const auto q = foot(scene.surface, ways.along, g + u);
        if (is_inside(part_of_way(foot(scene.surface, ways.along, g), q, of_way)))
          EXPECT_TRUE(is_within_a_step(load, of_way, longest_step_squared(scene.surface, ways.along)));
        else
          ++counts["refused at a border"];
      },
      tests::Friction::random);
}

GodObjectSession session_on(mesh::TriangleMesh mesh, mesh::Materials materials) {
  MeshRendering rendering = tests::unshaded(std::move(mesh), mesh::Sides::both);
  rendering.contact = mesh::Contact::friction;
  rendering.materials = std::move(materials);
  return GodObjectSession(tests::built(reference::GodObject::build(rendering)));
}

mesh::Materials one(float static_friction, float dynamic_friction) {
  return {{{.static_friction = static_friction, .dynamic_friction = dynamic_friction}}, {}};
}

// Its grid has all multiples of 2^-20 mm.
mesh::TriangleMesh floor() {
  return {{{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

// Two slopes of 45 degrees, which meet in a ridge along y, 8 mm high.
mesh::TriangleMesh roof() {
  return {{{-8, -8, 0}, {0, -8, 8}, {0, 8, 8}, {-8, 8, 0}, {8, -8, 0}, {8, 8, 0}},
          {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
}

TEST(friction_consequences, a_floor_holds_up_to_the_cone_and_lets_slip_one_number_beyond_it) {
  for (const float pulled : {1.5F, std::nextafter(1.5F, 2.0F)}) {
    GodObjectSession session = session_on(floor(), one(0.5F, 0.25F));
    session.step({1, -2, 1});
    const mesh::GodObject landed = session.step({1, -2, -1}).after;
    const mesh::Tick tick = session.step({pulled, -2, -1});
    const bool is_held = pulled == 1.5F;
    EXPECT_EQ(tick.after == landed, is_held);
    EXPECT_EQ(tick.after.is_slipping, !is_held);
    EXPECT_NEAR(tick.force[0], is_held ? -0.5F : -0.25F, 1e-6);
    EXPECT_EQ(tick.force[2], 1);
  }
}

TEST(friction_consequences, a_roof_holds_at_its_friction_angle_on_the_slope_and_on_the_ridge_and_not_one_number_below_it) {
  for (const float x : {2.0F, 0.0F})
    for (const float mu : {1.0F, std::nextafter(1.0F, 0.0F)}) {
      GodObjectSession session = session_on(roof(), one(mu, 0.5F));
      session.step({x, 1, 10});
      const mesh::Tick tick = session.step({x, 1, 7 - x});
      EXPECT_EQ(tick.moves == 1, mu == 1) << x;
      EXPECT_EQ(tick.force == (Position{0, 0, 1}), mu == 1) << x;
      EXPECT_EQ(tick.after.is_slipping, mu < 1) << x;
    }
}

TEST(friction_consequences, a_stroke_pulls_with_the_dynamic_coefficient_all_the_way_and_is_held_where_it_turns) {
  GodObjectSession session = session_on(floor(), one(0.5F, 0.25F));
  session.step({-6, -7, 1});
  Position p{-6, -7, -2};
  session.step(p);
  const auto advance = [&](float step) {
    p[0] += step;
    return session.step(p);
  };
  constexpr float kStep = 0.03125F;
  const mesh::GodObject landed = session.state();
  for (int i = 1; i <= 32; ++i) EXPECT_EQ(advance(kStep).after, landed) << "held until the pull is half of 2 mm";
  for (int i = 0; i < 250; ++i) {
    const mesh::Tick tick = advance(kStep);
    EXPECT_TRUE(tick.after.is_slipping);
    EXPECT_NEAR(tick.force[0], -0.5, 1e-6);
    EXPECT_EQ(tick.force[2], 2);
  }
  mesh::GodObject turned = session.state();
  for (int i = 1; i <= 47; ++i) {
    turned.is_slipping = i < 8;  // until the pull is half of a quarter of 2 mm
    EXPECT_EQ(advance(-kStep).after, turned) << i;
  }
  const mesh::Tick back = advance(-kStep);
  EXPECT_TRUE(back.after.is_slipping);
  EXPECT_NEAR(back.force[0], 0.5, 1e-6);
}

TEST(friction_consequences, an_infinite_coefficient_holds_until_nothing_presses) {
  GodObjectSession session = session_on(floor(), one(HUGE_VALF, HUGE_VALF));
  session.step({1, -2, 1});
  const mesh::GodObject landed = session.step({1, -2, -0.001F}).after;
  for (const Position& p : {Position{7, -6, -0x1p-30F}, Position{-7, 5, -9}, Position{900, 0, -1}, Position{1, -2, -1}})
    EXPECT_EQ(session.step(p).after, landed);
  EXPECT_EQ(session.step({3, -2.5F, 0}).force, (Position{0, 0, 0})) << "on the surface";
  EXPECT_EQ(session.step({3, -2.5F, 0x1p-30F}).status, Status::free);
}

TEST(friction_consequences, of_an_edge_the_stiffest_triangle_counts) {
  mesh::Materials materials{{{2.0F, HUGE_VALF, HUGE_VALF}, {8.0F, 0, 0}}, {0, 1}};
  for (const auto& [y, stiffness] : {std::pair(-2.0F, 2.0F), std::pair(1.0F, 8.0F), std::pair(2.0F, 8.0F)}) {
    GodObjectSession session = session_on(floor(), materials);
    session.step({1, y, 1});
    EXPECT_EQ(session.step({1, y, -1}).force, (Position{0, 0, stiffness})) << y;
  }
}

}  // namespace
}  // namespace forceshade
