// SPDX-License-Identifier: BSD-3-Clause
// Ticks that take many operations: on a needle through a cube and on plates and tips that hill climbing has found, and at
// vertices with many triangles.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "properties/positions.h"
#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using tests::BothSides;
using Place = Eigen::Vector3d;  // mm

constexpr float kStiffness = 0.3F;  // N/mm
// The limits of docs/god-object.md: with the first, no detour or landing of the tick begins.
constexpr int kMostTries = 256, kMostTriesOfADetour = 256;

MeshRendering rendering_of(const TriangleMesh& mesh, Sides sides,
                           mesh::SelfIntersections allowed = mesh::SelfIntersections::allowed) {
  return {tests::checked(mesh, allowed), {}, sides, mesh::Shading::none, kStiffness, {}};
}

mesh::Vertex vertex_at(const Place& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

// u, v, w: right-handed, half as long as the sides of the box.
void add_box(TriangleMesh& mesh, const Place& u, const Place& v, const Place& w) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(vertex_at((i & 4 ? u : Place(-u)) + (i & 2 ? v : Place(-v)) + (i & 1 ? w : Place(-w))));
  for (const auto& [i, j, k] : {std::array{0U, 1U, 3U},
                                {0U, 3U, 2U},
                                {4U, 6U, 7U},
                                {4U, 7U, 5U},
                                {0U, 4U, 5U},
                                {0U, 5U, 1U},
                                {2U, 3U, 7U},
                                {2U, 7U, 6U},
                                {0U, 2U, 6U},
                                {0U, 6U, 4U},
                                {1U, 5U, 7U},
                                {1U, 7U, 3U}})
    mesh.triangles.push_back({first + i, first + j, first + k});
}

// The box of 10^-3 x 10^-3 x 3 of a cube's side. Its grid's steps are three thousand times as long in one direction as in
// another: beside the cube's face, a god-object that took some short ones whenever they lead nearer would use up the 256 moves
// of a tick.
TEST(hard_ticks, a_god_object_on_a_needle_through_a_cube_does_not_creep) {
  std::size_t most = 0, ticks = 0, changed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    properties::Draws random(seed);
    TriangleMesh mesh;
    add_box(mesh, 5 * Place::UnitX(), 5 * Place::UnitY(), 5 * Place::UnitZ());
    const Place along = Place(1, random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)).normalized();
    const Place across = along.cross(Place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))).normalized();
    add_box(mesh, 0.005 * across, 0.005 * along.cross(across), 15 * along);
    BothSides both(rendering_of(mesh, Sides::front));
    const auto near_crossing = [&](double x) {
      return vertex_at(5 / along.x() * along + Place(x, random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)));
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
  TriangleMesh mesh;
  mesh.vertices = {{8.23545647F, -4.80977011F, 4.41627359F},
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
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  BothSides both(rendering_of(mesh, Sides::both));
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
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0},
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
    for (std::uint32_t i = 0; i < 9; ++i) mesh.triangles.push_back({apex, apex + 1 + i, apex + 1 + (i + 1) % 9});
  BothSides both(rendering_of(mesh, Sides::both));
  both.step({0, 0, 0});
  both.step({-0.775932133F, -5.9364686F, -0.751537442F});
  EXPECT_EQ(both.tries(), kMostTriesOfADetour);
}

// n triangles around the origin, which is a vertex; their other corners lie 50 mm off it, at heights up to 5 mm.
TriangleMesh fan(std::uint32_t n) {
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    mesh.vertices.push_back(vertex_at({50 * std::cos(angle), 50 * std::sin(angle), 0.05 * (7919 * i % 100)}));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

// Each triangle at a vertex meets a flight or a way through it, and to find how the vertex lies to it looks at each of them.
TEST(hard_ticks, a_tick_at_a_vertex_of_many_triangles_looks_at_each_of_them_but_a_few_times) {
  constexpr std::uint32_t kTriangles = 200;
  std::size_t most = 0, ticks = 0;
  for (const Sides sides : {Sides::front, Sides::both})
    for (const auto allowed : {mesh::SelfIntersections::refused, mesh::SelfIntersections::allowed})
      for (const float from : {3.0F, -3.0F})
        for (const std::array<float, 3>& to : {std::array{0.0F, 0.0F, -from}, {0.0F, 0.0F, 0.0F}, {0.1F, -0.2F, -from}}) {
          BothSides both(rendering_of(fan(kTriangles), sides, allowed));
          for (const std::array<float, 3>& p : {std::array{-to[0], -to[1], from}, to, std::array{0.3F, 0.1F, -from}}) {
            both.step(p);
            most = std::max(most, both.decisions()[0] + both.decisions()[1]);
            ++ticks;
          }
        }
  std::printf("  %zu ticks, at most %zu decisions for %u triangles\n", ticks, most, kTriangles);
  EXPECT_LE(most, 12 * kTriangles);
}

}  // namespace
}  // namespace forceshade
