// SPDX-License-Identifier: BSD-3-Clause
// The contact rule of Ruspini, Kolarov and Khatib: both sides against each other, and what the rule is for: a hand that is held
// still feels the interpolated normal.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using Position = std::array<float, 3>;

constexpr float kStiffness = 0.3F;  // N/mm

MeshRendering by_sub_goal(MeshRendering rendering, mesh::Shading shading) {
  rendering.shading = shading;
  rendering.contact = mesh::Contact::sub_goal;
  return rendering;
}

using Counts = tests::Occasions;

TEST(sub_goal, is_the_reference_in_every_bit_on_random_meshes_and_paths) {
  Counts counts;
  tests::expect_reference(
      66, 250, counts,
      [](tests::MeshSource& source, const tests::RandomMesh& made, mesh::Shading shading) {
        return by_sub_goal(tests::shaded(made.mesh, source.normals_of(made.mesh), made.sides, kStiffness), shading);
      },
      [&](const tests::ComparedTick& tick) {
        const bool was_inside = tick.before.place == mesh::Place::triangle;
        const mesh::Tick direct = fast::step(tick.both.mesh(), tick.before, tick.position, kStiffness, tick.rendering.shading);
        const bool is_same = direct.after == tick.expected.after;
        counts["a rest that the rule moves"] += was_inside && !is_same;
        counts["a rest that it leaves"] += was_inside && is_same;
        counts["from behind"] += was_inside && tick.before.side == mesh::Side::back && !is_same;
      });
  counts.expect_all({"a rest that the rule moves", "a rest that it leaves", "from behind", "decided in binary64",
                     "decided in wide numbers", "free", "touching", "invalid"});
}

// A level floor, whose normals at all corners are N.
MeshRendering floor_with(const mesh::Normal& N, float half, mesh::Sides sides = mesh::Sides::front) {
  mesh::TriangleMesh floor{{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  return by_sub_goal(tests::shaded(std::move(floor), mesh::CornerNormals(2, {N, N, N}), sides, kStiffness),
                     mesh::Shading::none);
}

// With the angle θ between N and n, a tick takes away all but sin²θ of what the god-object is off its place, where D is along
// N.
TEST(sub_goal, a_hand_that_is_held_still_feels_the_interpolated_normal) {
  const Eigen::Vector3d N(0.6F, 0, 0.8F);
  const auto session = tests::built(fast::GodObject::build(floor_with({0.6F, 0, 0.8F}, 50))).open();
  session->tick({1, 2, 3});
  const Position p{1, 2, -2};
  double off = 0;
  for (int i = 0; i < 40; ++i) {
    const mesh::Tick tick = session->tick(p);
    const Eigen::Vector3d F = Eigen::Vector3f(tick.force[0], tick.force[1], tick.force[2]).cast<double>();
    const double now = (F.normalized() - N.normalized()).norm();
    if (i == 0) {
      EXPECT_EQ(tick.force[0], 0) << "the landing is direct";
    }
    if (i > 0 && i < 12) {
      EXPECT_NEAR(F.x(), 0.3 * 2 * 0.75 * (1 - std::pow(0.36, i)), 1e-6) << i;
    }
    off = now;
  }
  EXPECT_LT(off, 1e-6);
}

TEST(sub_goal, a_plane_that_is_not_turned_changes_nothing) {
  for (const mesh::Normal& N :
       {mesh::Normal{0, 0, 1}, mesh::Normal{0, 0, 0.375F}, mesh::Normal{0, 0, 0}, mesh::Normal{0, 0, -1}}) {
    MeshRendering rendering = floor_with(N, 50);
    const auto turned = tests::built(fast::GodObject::build(rendering)).open();
    rendering.contact = mesh::kUsualContact;
    const auto direct = tests::built(fast::GodObject::build(rendering)).open();
    for (const Position& p : {Position{1, 2, 3}, Position{1, 2, -2}, Position{1.7F, 2.3F, -0.1F}, Position{-3, 2.3F, -7.7F},
                              Position{1, 1, 0}, Position{1, 1.5F, 0}, Position{2, 2, 0.5F}})
      EXPECT_TRUE(tests::is_same(turned->tick(p), direct->tick(p)));
  }
}

// At the floor's rim the sub-goal is beside the floor and the descent to it ends free: then the hand's position is the goal.
TEST(sub_goal, a_sub_goal_off_the_surface_does_not_let_go_of_it) {
  const auto session = tests::built(fast::GodObject::build(floor_with({0.8F, 0, 0.6F}, 5))).open();
  session->tick({4.5F, 0.25F, 1});
  for (int i = 0; i < 20; ++i) {
    const mesh::Tick tick = session->tick({4.5F, 0.25F, -3});
    EXPECT_EQ(tick.status, Status::contact);
    EXPECT_FLOAT_EQ(tick.force[2], 0.9F);
  }
  EXPECT_EQ(session->tick({4.5F, 0.25F, 0.5F}).status, Status::free);
}

// A sub-goal is limited to the domain of positions. Here its end is the floor's rim, from which the way to the sub-goal is
// open: the hand's position is the goal again.
TEST(sub_goal, beyond_the_domain_is_at_its_end) {
  tests::BothSides both(floor_with({0.8F, 0, 0.6F}, 10000));
  const Position above{9990, 1, 100}, below{9990, 1, -900};
  for (const Position& p : {above, below, below, below, below}) both.step(p);
  EXPECT_EQ(both.state().place, mesh::Place::triangle);
}

// On a slope of 45° a goal at the end of the domain has its foot far inside: the limit moves that.
TEST(sub_goal, is_limited_coordinate_by_coordinate) {
  mesh::TriangleMesh slope{{{-8000, -8000, -8000}, {8000, -8000, 8000}, {8000, 8000, 8000}, {-8000, 8000, -8000}},
                           {{0, 1, 2}, {0, 2, 3}}};
  const double half = std::sqrt(0.5);  // of the slope's normal (-1, 0, 1) and the way up it (1, 0, 1)
  const mesh::Normal N{static_cast<float>(half * (0.6 - 0.8)), 0, static_cast<float>(half * (0.6 + 0.8))};
  tests::BothSides both(by_sub_goal(
      tests::shaded(std::move(slope), mesh::CornerNormals(2, {N, N, N}), mesh::Sides::front, kStiffness), mesh::Shading::none));
  constexpr double kDepth = 6000;
  const Position above{4000, 1, 6000},
      below{static_cast<float>(5000 + kDepth * half), 1, static_cast<float>(5000 - kDepth * half)};
  mesh::Tick tick;
  for (const Position& p : {above, below, below}) tick = both.step(p);
  const double z = 5000 - kDepth * half + kDepth * 0.48 * half, foot = (10000 + z) / 2;  // x would be 11279
  EXPECT_NEAR(static_cast<double>(tick.force[0]), 0.3 * (foot - (5000 + kDepth * half)), 0.01);
}

TEST(sub_goal, without_corner_normals_is_refused) {
  MeshRendering rendering = floor_with({0, 0, 1}, 5);
  rendering.normals.clear();
  const auto refusal = [](const auto& built) { return std::get<ParameterError>(built).message(); };
  const std::string words = refusal(reference::GodObject::build(rendering));
  EXPECT_NE(words.find("number of triangles with normals is 0"), std::string::npos) << words;
  EXPECT_EQ(refusal(fast::GodObject::build(rendering)), words);
}

}  // namespace
}  // namespace forceshade
