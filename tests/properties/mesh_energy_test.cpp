// SPDX-License-Identifier: BSD-3-Clause
// The energy that the shading of a mesh can give: no rest turns a force by more than stated, and a stroke gives as stated.

#include "properties/mesh_energy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "tests/meshes/rendering.h"
#include "tests/support/mesh_source.h"

namespace forceshade::properties {
namespace {

MeshRendering of_family(std::size_t family, std::uint64_t seed) {
  tests::MeshSource source(seed);
  tests::RandomMesh random = source.of_family(family);
  mesh::CornerNormals normals = source.normals_of(random.mesh);
  return tests::shaded(std::move(random.mesh), std::move(normals), random.sides, 0.5F);
}

double limit_at(const mesh::GodObject& state, const LargestTurns& turns) {
  switch (state.place) {
    case mesh::Place::triangle: return turns.of_triangle[state.index[0]];
    case mesh::Place::edge: return turns.edges;
    default: return turns.vertices;
  }
}

// Farther off than this the rounding of the state, which the limit leaves out, turns D by less than the slack.
constexpr double kFar = 0.05, kSlack = 1e-3;  // of the longest side; of a chord

TEST(mesh_energy, no_rest_turns_a_force_by_more) {
  std::array<std::size_t, 3> checked{};  // inside, on edges, at vertices
  for (std::size_t family = 0; family < tests::kMeshFamilies.size(); ++family)
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const MeshRendering rendering = of_family(family, 100 * family + seed);
      const LargestTurns turns = largest_turns(rendering);
      EXPECT_LE(turns.inside_at_least, turns.inside);
      const auto session = fast::GodObject(std::get<fast::GodObject>(fast::GodObject::build(rendering))).open();
      MeshPath path(rendering.mesh(), seed);
      double longest = 0;
      for (const auto& [a, b, c] : rendering.mesh().triangles)
        longest = std::max(longest, (vector_of(rendering.mesh().vertices[a]) - vector_of(rendering.mesh().vertices[b])).norm());
      for (int i = 0; i < 3000; ++i) {
        const MeshPosition position = path.next();
        const mesh::Tick tick = session->tick(position);
        if (tick.status != Status::contact) continue;
        const Eigen::Vector3d D = point_of(rendering.mesh(), tick.after) - vector_of(position), F = vector_of(tick.force);
        if (!(D.norm() > kFar * longest)) continue;
        const double turn = (F.normalized() - D.normalized()).norm();
        EXPECT_LE(turn, limit_at(tick.after, turns) + kSlack)
            << tests::kMeshFamilies[family] << " " << seed << ", tick " << i << ", " << static_cast<int>(tick.after.place);
        ++checked[tick.after.place == mesh::Place::triangle ? 0 : tick.after.place == mesh::Place::edge ? 1 : 2];
      }
    }
  EXPECT_GT(checked[0], 3000U);
  EXPECT_GT(checked[1], 1000U);
  EXPECT_GT(checked[2], 300U);
}

// Two triangles in the plane z = 0, all of whose corners have the normal (sin a, 0, cos a).
MeshRendering tilted_square(double angle) {
  mesh::TriangleMesh square{.vertices = {{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
  const mesh::Normal normal{static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
  return tests::shaded(std::move(square), {{normal, normal, normal}, {normal, normal, normal}}, mesh::Sides::front, 0.5F);
}

// The work of a stroke of one turn everywhere is known: K sin a times the area of the path in x and depth.
TEST(mesh_energy, a_stroke_gives_what_is_known_and_what_the_reference_gives) {
  constexpr double kAngle = 0.3, kDepth = 0.5, kLength = 30;
  const MeshRendering rendering = tilted_square(kAngle);
  const LargestTurns turns = largest_turns(rendering);
  EXPECT_NEAR(turns.inside, 2 * std::sin(kAngle / 2), 1e-6);
  EXPECT_EQ(turns.vertices, 0) << "each vertex is at the rim";
  const MeshStroke stroke = best_stroke(rendering, turns, kDepth, kLength, {});
  ASSERT_EQ(stroke.corners.size(), 5U);
  EXPECT_LE(stroke.length, kLength);
  EXPECT_EQ(stroke.corners.front(), stroke.corners.back());
  const double x = std::fabs(static_cast<double>(stroke.corners[2][0] - stroke.corners[1][0])), depth = 0.995 * kDepth;
  EXPECT_GT(x, 5);
  EXPECT_NEAR(stroke.work - stroke.sampling, 0.5 * std::sin(kAngle) * x * depth, 0.02 * stroke.work);
  EXPECT_LT(stroke.sampling, 0.011 * stroke.work);
  EXPECT_LE(stroke.rate(), 0.5 * kDepth * turns.most());
  EXPECT_GT(stroke.rate(), 0.5 * kDepth * turns.most() / 3);

  // The exact god-object along the same corners, in other steps.
  reference::GodObjectSession session(std::get<reference::GodObject>(reference::GodObject::build(rendering)));
  constexpr int kSteps = 200;
  Eigen::Vector3d last = vector_of(stroke.corners.front()), push(0, 0, 0);
  double work = 0;
  for (std::size_t i = 1; i < stroke.corners.size(); ++i)
    for (int k = 1; k <= kSteps; ++k) {
      const Eigen::Vector3d from = vector_of(stroke.corners[i - 1]), to = vector_of(stroke.corners[i]);
      const Eigen::Vector3f p = (from + k * (to - from) / kSteps).cast<float>();
      const Eigen::Vector3d force = vector_of(session.step({p.x(), p.y(), p.z()}).force);
      work += 0.5 * (push + force).dot(p.cast<double>() - last);
      last = p.cast<double>();
      push = force;
    }
  EXPECT_NEAR(work, stroke.work - stroke.sampling, 0.02 * stroke.work);
}

// The hand comes from behind to the apex of a pyramid without a bottom, or to the ridge of a roof, where the god-object rests
// in a valley; from the front it rests at neither.
TEST(mesh_energy, counts_the_valleys_that_are_behind) {
  constexpr double kAngle = 0.2;
  const mesh::Normal tilted{static_cast<float>(std::sin(kAngle)), 0, static_cast<float>(std::cos(kAngle))};
  const mesh::TriangleMesh pyramid{.vertices = {{0, 0, 5}, {10, 0, 0}, {0, 10, 0}, {-10, 0, 0}, {0, -10, 0}},
                                   .triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const mesh::TriangleMesh roof{.vertices = {{0, -10, 5}, {0, 10, 5}, {10, 0, 0}, {-10, 0, 0}},
                                .triangles = {{0, 2, 1}, {0, 1, 3}}};
  // Each triangle of the roof has its own normal, so that the ridge is a crease.
  const mesh::Normal other{tilted[0], 0.01F, tilted[2]};
  for (const bool is_roof : {false, true})
    for (const mesh::Sides sides : {mesh::Sides::front, mesh::Sides::both}) {
      const MeshRendering rendering =
          is_roof ? tests::shaded(roof, {{tilted, tilted, tilted}, {other, other, other}}, sides, 0.5F)
                  : tests::shaded(pyramid, mesh::CornerNormals(4, {tilted, tilted, tilted}), sides, 0.5F);
      const LargestTurns turns = largest_turns(rendering);
      const auto session = std::get<fast::GodObject>(fast::GodObject::build(rendering)).open();
      session->tick({0.001F, 0.001F, 1});
      const mesh::Tick tick = session->tick({0.001F, 0.001F, 6});
      if (sides == mesh::Sides::front) {
        EXPECT_EQ(is_roof ? turns.edges : turns.vertices, 0);
        EXPECT_EQ(tick.status, Status::free);
        continue;
      }
      ASSERT_EQ(tick.after.place, is_roof ? mesh::Place::edge : mesh::Place::vertex);
      const double turn = (vector_of(tick.force).normalized() - Eigen::Vector3d(0, 0, -1)).norm();
      EXPECT_NEAR(turn, 2 * std::sin(kAngle / 2), 0.02);
      EXPECT_GE((is_roof ? turns.edges : turns.vertices) + kSlack, turn);
    }
}

// A straight stroke that leaves its triangle along x comes below a step of 1 mm, where it would be given more.
TEST(mesh_energy, a_stroke_is_nowhere_deeper_than_said) {
  constexpr double kDepth = 0.2;
  const mesh::Normal tilted{static_cast<float>(std::sin(0.3)), 0, static_cast<float>(std::cos(0.3))};
  mesh::TriangleMesh step;
  for (const auto& [x, z] : {std::pair(0.0F, 0.0F), {20.0F, 0.0F}, {22.0F, 1.0F}, {60.0F, 1.0F}})
    for (const float y : {0.0F, 20.0F}) step.vertices.push_back({x, y, z});
  for (std::uint32_t i = 0; i < 3; ++i) {
    step.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    step.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  mesh::CornerNormals normals(step.triangles.size(), {tilted, tilted, tilted});
  const mesh::Normal its_own{-0.4472136F, 0, 0.8944272F};
  normals[2] = normals[3] = {its_own, its_own, its_own};  // of the ramp, which is not shaded
  const MeshRendering rendering = tests::shaded(step, normals, mesh::Sides::front, 0.5F);
  const MeshStroke stroke = best_stroke(rendering, largest_turns(rendering), kDepth, 200, {});
  ASSERT_FALSE(stroke.corners.empty());
  const auto session = std::get<fast::GodObject>(fast::GodObject::build(rendering)).open();
  for (std::size_t i = 1; i < stroke.corners.size(); ++i)
    for (int k = 0; k <= 1000; ++k) {
      const Eigen::Vector3d from = vector_of(stroke.corners[i - 1]), to = vector_of(stroke.corners[i]);
      const Eigen::Vector3f p = (from + k * (to - from) / 1000).cast<float>();
      EXPECT_LE(vector_of(session->tick({p.x(), p.y(), p.z()}).force).norm(), 0.5 * kDepth * 1.001);
    }
}

TEST(mesh_energy, without_shading_there_is_nothing_to_bound) {
  MeshRendering rendering = tilted_square(0.3);
  rendering.shading = mesh::Shading::none;
  EXPECT_EQ(largest_turns(rendering).most(), 0);
  EXPECT_EQ(why_no_energy_bound(rendering), "");
}

TEST(mesh_energy, says_what_was_expected_where_there_is_no_bound) {
  const auto refusal = [](auto change) {
    MeshRendering rendering = tilted_square(0.3);
    change(rendering);
    return why_no_energy_bound(rendering);
  };
  EXPECT_EQ(refusal([](MeshRendering& r) { r.shading = mesh::Shading::edge_scheme; }),
            "expected the shading none or vertex, got another one");
  EXPECT_EQ(refusal([](MeshRendering& r) { r.contact = mesh::Contact::sub_goal; }),
            "expected the contact rule direct, got sub-goal");
  EXPECT_EQ(refusal([](MeshRendering& r) { r.materials.list = {{.static_friction = 0.3F, .dynamic_friction = 0.2F}}; }),
            "expected a mesh without friction, got coefficients of friction");
  EXPECT_EQ(refusal([](MeshRendering& r) { r.materials.list = {{.stiffness = 1.0F}}; }),
            "expected one stiffness, got materials with their own");
}

TEST(mesh_energy, is_interrupted) {
  const MeshRendering rendering = tilted_square(0.3);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(best_stroke(rendering, largest_turns(rendering), 0.5, 30, Monitor({}, stop)), Interrupted);
}

}  // namespace
}  // namespace forceshade::properties
