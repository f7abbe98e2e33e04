// SPDX-License-Identifier: BSD-3-Clause
// The change of the force on a mesh between two ticks: no path exceeds the bound, and where it is known it is met.

#include "properties/tick_changes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <numbers>

#include "forceshade/fast.h"
#include "properties/mesh_source.h"
#include "properties/positions.h"
#include "properties/rest_regions.h"
#include "tests/meshes/rendering.h"
#include "tests/support/drawn.h"

namespace forceshade::properties {
namespace {

using Eigen::Vector3d;

constexpr HandStep kHand{.depth = 1, .step = 0.1};

MeshRendering of_family(std::size_t family, std::uint64_t seed, bool is_shaded) {
  MeshSource source(seed);
  RandomMesh random = source.of_family(family);
  mesh::CornerNormals normals = source.normals_of(random.mesh);
  return is_shaded ? tests::shaded(std::move(random.mesh), std::move(normals), random.sides)
                   : tests::unshaded(std::move(random.mesh), random.sides);
}

// A cube from 0 to 10 mm.
mesh::TriangleMesh cube() {
  mesh::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.push_back({i & 1 ? 10.0F : 0.0F, i & 2 ? 10.0F : 0.0F, i & 4 ? 10.0F : 0.0F});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A hand that presses and rubs: along a direction for some ticks, and to and fro across the surface; steps of its own, which
// tick_changes() does not make.
template <typename Take>
void rub(const MeshRendering& rendering, std::uint64_t seed, const Take& take) {
  const fast::GodObject open = tests::built(fast::GodObject::build(rendering));
  const mesh::TriangleMesh& mesh = rendering.mesh();
  class Hand : public Draws {
   public:
    using Draws::Draws;
    Vector3d any() { return Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); }
  } hand(seed);
  const std::size_t stretches = tests::drawn(150);
  for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
    const auto session = open.open();
    const std::uint32_t t = static_cast<std::uint32_t>(hand.bits() % mesh.triangles.size());
    Vector3d p = Vector3d::Zero();
    for (const std::uint32_t v : mesh.triangles[t]) p += vector_of(mesh.vertices[v]) / 3;
    p += 0.05 * unit_normal(mesh, t).direction;
    bool has_last = false;
    Vector3d last = Vector3d::Zero();
    Vector3d way = hand.any();
    for (int i = 0; i < 150; ++i) {
      const MeshPosition position{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
      const mesh::Tick tick = session->tick(position);
      const Vector3d force = vector_of(tick.force);
      const bool counts = tick.status == Status::contact && force.norm() > 0.05 &&
                          force.norm() <= static_cast<double>(rendering.stiffness) * kHand.depth;
      if (counts && has_last) take(last, force);
      has_last = counts;
      last = force;
      if (hand.bits() % 8 == 0) way = hand.any();
      const Vector3d in = force.norm() > 0 ? Vector3d(-force.normalized()) : Vector3d(-unit_normal(mesh, t).direction);
      p += 0.99 * kHand.step * (way + hand.uniform(-0.7, 1) * in).normalized();
    }
  }
}

TEST(tick_changes, no_path_exceeds_the_bounds) {
  std::size_t counted = 0;
  for (std::size_t family = 0; family < kMeshFamilies.size(); ++family)
    for (const bool is_shaded : {false, true}) {
      const MeshRendering rendering = of_family(family, 100 * family + 1, is_shaded);
      if (rendering.mesh().triangles.size() > 60) continue;  // these take long
      const TickChanges changes = tick_changes(rendering, kHand, {});
      EXPECT_LE(changes.force.found, changes.force.bound) << kMeshFamilies[family];
      EXPECT_LE(changes.turn.found, changes.turn.bound) << kMeshFamilies[family];
      rub(rendering, family, [&](const Vector3d& one, const Vector3d& other) {
        ++counted;
        EXPECT_LE((one - other).norm(), changes.force.bound) << kMeshFamilies[family] << " " << is_shaded;
        const double turn = std::atan2(one.cross(other).norm(), one.dot(other)) * 180 / std::numbers::pi;
        EXPECT_LE(turn, changes.turn.bound) << kMeshFamilies[family] << " " << is_shaded;
      });
    }
  EXPECT_GT(counted, tests::drawn(10000));
}

// Beside an edge the hand may be as deep below one face as below the other: from (0, 0, depth) to (depth, 0, 0), and by what a
// step changes.
TEST(tick_changes, an_edge_of_a_cube_turns_the_force_by_90_degrees_at_most) {
  const TickChanges changes = tick_changes(tests::unshaded(cube(), mesh::Sides::front), kHand, {});
  ASSERT_TRUE(changes.is_own);
  EXPECT_NEAR(changes.turn.bound, 90, 0.01);
  EXPECT_GE(changes.force.found, 0.9 * kHand.step);
  EXPECT_LE(changes.force.bound, std::numbers::sqrt2 * (kHand.depth + kHand.step) + kHand.step + 1e-3);
}

// A flat sheet: the direction is the same, and the force changes by what the hand moves.
TEST(tick_changes, on_a_flat_sheet_the_force_changes_by_the_step) {
  const mesh::TriangleMesh sheet{{{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  for (const mesh::Sides sides : {mesh::Sides::front, mesh::Sides::both}) {
    const TickChanges changes = tick_changes(tests::unshaded(sheet, sides), kHand, {});
    ASSERT_TRUE(changes.is_own);
    EXPECT_NEAR(changes.force.bound, kHand.step, 1e-3);
    EXPECT_NEAR(changes.turn.bound, 0, 0.01);
    EXPECT_GT(changes.force.bound, kHand.step) << "by the grid of the state and the rounding of the force";
    EXPECT_GT(changes.turn.bound, 0) << "by these, too";
    EXPECT_GE(changes.force.found, 0.99 * kHand.step);
  }
}

TEST(tick_changes, inside_of_one_triangle_the_force_changes_by_the_step) {
  const mesh::TriangleMesh triangle{{{0, 0, 0}, {20, 0, 0}, {0, 20, 0}}, {{0, 1, 2}}};
  const TickChanges changes = tick_changes(tests::unshaded(triangle, mesh::Sides::front), kHand, {});
  EXPECT_NEAR(changes.force.bound, kHand.step, 1e-3);
  EXPECT_GE(changes.force.found, 0.99 * kHand.step);
}

// Stairs that are narrower than a step of the hand, 0.4 mm high each: the hand goes from one to the next but one, and the force
// falls by that of two.
TEST(tick_changes, a_step_may_go_over_a_triangle) {
  mesh::TriangleMesh stairs;
  const auto add = [&](float x, float z) {
    stairs.vertices.push_back({x, 0, z});
    stairs.vertices.push_back({x, 20, z});
    const auto n = static_cast<std::uint32_t>(stairs.vertices.size());
    if (n < 4) return;
    stairs.triangles.push_back({n - 4, n - 2, n - 1});
    stairs.triangles.push_back({n - 4, n - 1, n - 3});
  };
  add(-10, 0);
  add(0, 0);
  add(0, -0.4F);
  add(0.05F, -0.4F);
  add(0.05F, -0.8F);
  add(10, -0.8F);
  const TickChanges changes = tick_changes(tests::unshaded(stairs, mesh::Sides::front), kHand, {});
  ASSERT_TRUE(changes.is_own);
  EXPECT_GE(changes.force.bound, 0.8);
  EXPECT_GE(changes.force.found, 0.79);
  EXPECT_LE(changes.force.found, changes.force.bound);
}

// The thesis's idea in numbers: with interpolated normals the force turns by a little from tick to tick, not by the angle of an
// edge at once.
TEST(tick_changes, shading_takes_the_edges_away) {
  mesh::TriangleMesh roof{{{-10, 0, 0}, {0, 0, 2}, {10, 0, 0}, {-10, 20, 0}, {0, 20, 2}, {10, 20, 0}},
                          {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
  const double angle = 2 * std::atan2(2, 10) * 180 / std::numbers::pi;
  const TickChanges flat = tick_changes(tests::unshaded(roof, mesh::Sides::front), kHand, {});
  EXPECT_NEAR(flat.turn.bound, angle, 0.01);
  EXPECT_NEAR(flat.turn.found, angle, 1e-3);
  const auto normal = [](double x) {
    const double a = x / 10 * std::atan2(2, 10);
    return mesh::Normal{static_cast<float>(std::sin(a)), 0, static_cast<float>(std::cos(a))};
  };
  mesh::CornerNormals normals;
  for (const mesh::Triangle& triangle : roof.triangles) {
    auto& corners = normals.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) corners[i] = normal(static_cast<double>(roof.vertices[triangle[i]][0]));
  }
  const TickChanges shaded = tick_changes(tests::shaded(roof, normals, mesh::Sides::front), kHand, {});
  EXPECT_LT(shaded.turn.bound, angle / 4);
  EXPECT_GT(shaded.turn.found, shaded.turn.bound / 4);
}

TEST(tick_changes, what_was_found_happens_there) {
  const MeshRendering rendering = of_family(8, 801, true);
  const TickChanges changes = tick_changes(rendering, kHand, {});
  for (const Change& change : {changes.force, changes.turn}) {
    const Vector3d step = vector_of(change.at[1]) - vector_of(change.at[0]);
    EXPECT_GT(step.norm(), 0);
    EXPECT_LE(step.norm(), kHand.step);
  }
  EXPECT_GT(changes.moves, 0U);
  const TickChanges again = tick_changes(rendering, kHand, {});
  EXPECT_EQ(again.force.found, changes.force.found);
  EXPECT_EQ(words_of(again, kHand), words_of(changes, kHand));
}

TEST(tick_changes, are_said_to_be_no_smaller_than_they_are) {
  TickChanges changes;
  changes.force.bound = 1.23401;
  changes.force.found = 0.5;
  changes.turn.bound = 12.3401;
  changes.turn.found = 0.25;
  changes.moves = 7;
  EXPECT_EQ(words_of(changes, kHand),
            "between two ticks in contact, no more than 1 mm deep, the hand 0.1 mm further (100 mm/s at 1000 ticks a second): "
            "at most "
            "1.235 N and 12.35 degrees; found: 0.5 N, 0.25 degrees, and 7 moves of one tick");
}

TEST(tick_changes, a_longer_step_has_no_smaller_bound) {
  const MeshRendering rendering = of_family(10, 1001, true);
  double last = 0;
  for (const double step : {0.02, 0.2}) {
    const TickChanges changes = tick_changes(rendering, {.depth = 1, .step = step}, {});
    EXPECT_GE(changes.force.bound, last);
    last = changes.force.bound;
  }
}

TEST(tick_changes, can_be_interrupted) {
  const std::atomic<bool> stop = true;
  EXPECT_THROW(tick_changes(of_family(8, 801, true), kHand, Monitor({}, stop)), Interrupted);
}

TEST(rest_regions, a_box_has_its_eight_corners) {
  std::vector<HalfSpace> borders;
  for (const int axis : {0, 1, 2})
    for (const double sign : {1.0, -1.0}) borders.push_back({sign * Vector3d::Unit(axis), sign > 0 ? 5000 : -5001.0});
  std::size_t count = 0;
  for_each_corner(borders, Vector3d(5000, 5000, 5000), 1e-9, [&](const Vector3d& corner) {
    ++count;
    for (const double coordinate : corner) EXPECT_NEAR(std::fabs(coordinate - 5000.5), 0.5, 1e-9);
  });
  EXPECT_EQ(count, 8U);
}

// A triangle has a region on each side that blocks motion; a ridge has one from behind, a valley from the front.
TEST(rest_regions, are_of_triangles_valleys_and_pits) {
  const mesh::TriangleMesh roof{{{-10, 0, 0}, {0, 0, 2}, {10, 0, 0}, {-10, 20, 0}, {0, 20, 2}, {10, 20, 0}},
                                {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
  const MeshRendering front = tests::unshaded(roof, mesh::Sides::front), both = tests::unshaded(roof, mesh::Sides::both);
  EXPECT_EQ(rest_regions(front, 1).all.size(), 4U);
  EXPECT_EQ(rest_regions(both, 1).all.size(), 9U);
  EXPECT_EQ(rest_regions(front, 1).rim.size(), 6U);
  mesh::TriangleMesh pit{{{0, 0, 0}, {9, 0, 4}, {0, 9, 4}, {-9, 0, 4}, {0, -9, 4}},
                         {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const RestRegions regions = rest_regions(tests::unshaded(pit, mesh::Sides::front), 1);
  EXPECT_EQ(regions.all.size(), 9U) << "4 triangles, 4 valleys, 1 vertex";
  for (const RestRegion& region : regions.all)
    for (const Vector3d& p : region.corners) EXPECT_LE(region.D(p).norm(), 1.8) << "no much farther than the depth";
}

}  // namespace
}  // namespace forceshade::properties
