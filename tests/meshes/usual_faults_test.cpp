// SPDX-License-Identifier: BSD-3-Clause
// The usual faults of a god-object, each with a test that the one of this project does not have it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "fast/meshes/session.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"
#include "tests/meshes/rendering.h"

namespace forceshade {
namespace {

using fast::MeshSession;
using mesh::Place;
using mesh::Shading;
using mesh::Sides;
using Position = std::array<float, 3>;

constexpr float kStiffness = 0.5F;  // N/mm

std::shared_ptr<const fast::Mesh> built(const mesh::TriangleMesh& triangles, Sides sides,
                                        const mesh::CornerNormals& normals = {}) {
  return std::make_shared<const fast::Mesh>(
      tests::fast_mesh(normals.empty() ? tests::unshaded(triangles, sides) : tests::shaded(triangles, normals, sides)));
}

double length(const std::array<double, 3>& a) {
  return std::hypot(a[0], a[1], a[2]);
}
// Radians.
double angle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const std::array<double, 3> cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return std::atan2(length(cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
std::array<double, 3> binary64(const Position& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

// The path of the benchmark around the sphere, 0.5 to 2 mm deep.
Position around_the_sphere(double t) {
  constexpr double kPi = std::numbers::pi;
  const double theta = kPi / 2 + 1.30 * std::sin(2 * kPi * 0.110 * t), phi = 2 * kPi * 0.170 * t;
  const double radius = 50 - (1.25 + 0.75 * std::sin(2 * kPi * 1.30 * t));
  return {static_cast<float>(radius * std::sin(theta) * std::cos(phi)),
          static_cast<float>(radius * std::sin(theta) * std::sin(phi)), static_cast<float>(radius * std::cos(theta))};
}

// The cosine of the largest angle at the centre between a triangle's normal and its corners, which lie on the sphere: the
// smallest distance of a triangle's plane from the centre, in radii.
double least_cosine(const mesh::TriangleMesh& sphere, double radius) {
  double least = 1;
  for (const mesh::Triangle& t : sphere.triangles) {
    std::array<double, 3> a = binary64(sphere.vertices[t[0]]), e1{}, e2{};
    for (std::size_t i = 0; i < 3; ++i) {
      e1[i] = static_cast<double>(sphere.vertices[t[1]][i]) - a[i];
      e2[i] = static_cast<double>(sphere.vertices[t[2]][i]) - a[i];
    }
    const std::array<double, 3> n{e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2], e1[0] * e2[1] - e1[1] * e2[0]};
    least = std::fmin(least, (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / length(n) / radius);
  }
  return least;
}

// A rest in a triangle has the force along the triangle's normal. Let rho be the largest angle at the centre between a
// triangle's normal and one of its points: that of a corner. The position p is inside the sphere, and p's foot in the triangle
// is p plus a multiple of the normal. So both have the same distance from the normal's line through the centre: |p| sin(p,
// normal) = |foot| sin(foot, normal) <= R sin(rho). Two forces in turn therefore differ by the angle between the two positions,
// which is the turn on the exact sphere, and by twice asin(R sin(rho)/|p|), which is a facet's angle as it is seen at p.
TEST(usual_faults, the_force_does_not_turn_to_and_fro_on_a_sphere) {
  constexpr double kRadius = 50;
  for (const std::uint32_t frequency : {7U, 22U, 71U}) {
    const mesh::TriangleMesh sphere = mesh::icosphere(frequency, kRadius);
    // Rounding moves a corner by less than 2^-18 mm away from the centre, which is 2^-23 of the cosine. The last summand covers
    // what this does to an angle of 0.01 or more.
    const double rho = std::acos(least_cosine(sphere, kRadius)) + 0x1p-16;
    ASSERT_GT(rho, 0.01);
    MeshSession session(built(sphere, Sides::front), kStiffness, Shading::none);
    session.tick({60, 0, 0});
    Position before{}, force_before{};
    double most = 0, most_of_bound = 0;
    int facets = 0, turns_back = 0;
    std::uint32_t facet = 0, facet_before = 0;
    for (int i = 0; i < 100000; ++i) {
      const Position p = around_the_sphere(1e-3 * i);
      const mesh::Tick tick = session.tick(p);
      ASSERT_EQ(tick.status, Status::contact) << i;
      ASSERT_EQ(tick.after.place, Place::triangle) << i;
      if (i > 0) {
        const auto seen = [&](const Position& at) { return std::asin(kRadius * std::sin(rho) / length(binary64(at))); };
        const double turn = angle(binary64(force_before), binary64(tick.force));
        const double exact = angle(binary64(before), binary64(p)), bound = exact + seen(before) + seen(p);
        ASSERT_LE(turn, bound) << "tick " << i;
        ASSERT_LE(turn, 2 * exact + seen(before) + seen(p)) << "tick " << i;
        most = std::fmax(most, turn);
        most_of_bound = std::fmax(most_of_bound, turn / bound);
        if (tick.after.index[0] != facet) {
          ++facets;
          turns_back += tick.after.index[0] == facet_before;
          facet_before = facet;
        }
      }
      facet = tick.after.index[0];
      before = p;
      force_before = tick.force;
    }
    std::printf(
        "  %zu triangles: %d changes of the triangle, %d back to the one before; the largest turn %.4f rad, %.2f of its "
        "bound\n",
        sphere.triangles.size(), facets, turns_back, most, most_of_bound);
    EXPECT_GT(facets, 1000);
    // A sawtooth goes back at every second change. A smooth path goes back only where it cuts a corner of a triangle twice.
    EXPECT_LT(10 * turns_back, facets);
  }
}

// ---- Passing through.

// Straight down through a wall without thickness, and along slanted lines; through its triangles, edges and vertices. Below,
// the foot of the position is in the wall, so the god-object comes to rest above it.
TEST(usual_faults, a_jump_of_10_m_does_not_pass_through_a_thin_wall) {
  const auto wall = built(mesh::thin_wall(100, 100, 4, 4), Sides::both);
  int jumps = 0;
  for (const float x : {0.0F, 25.0F, 10.0F, -7.3F})
    for (const float y : {0.0F, -25.0F, 10.0F, 3.1F})
      for (const float slant : {0.0F, 20.0F, 70.0F}) {
        MeshSession session(wall, kStiffness, Shading::none);
        ASSERT_EQ(session.tick({x - slant, y, 5000}).status, Status::free);
        const mesh::Tick below = session.tick({x, y, -5000});
        ASSERT_EQ(below.status, Status::contact) << x << " " << y << " " << slant;
        EXPECT_EQ(below.after.side, mesh::Side::front);
        EXPECT_EQ(below.force, (Position{0, 0, 2500}));
        const mesh::Tick above = session.tick({x, y, 5000});
        EXPECT_EQ(above.status, Status::free);
        EXPECT_EQ(above.force, (Position{0, 0, 0}));
        ++jumps;
      }
  EXPECT_EQ(jumps, 48);
}

// The top of a plate of 0.01 mm holds what comes from above, at whatever speed, and not the bottom.
TEST(usual_faults, a_jump_of_10_m_stops_at_the_first_of_two_sheets_that_nearly_touch) {
  MeshSession session(built(mesh::box(100, 100, 0.01), Sides::front), kStiffness, Shading::none);
  session.tick({1, 2, 5000});
  const mesh::Tick tick = session.tick({3, 4, -5000});
  ASSERT_EQ(tick.status, Status::contact);
  const double height = static_cast<double>(static_cast<float>(0.005)) + 5000;
  EXPECT_EQ(tick.force, (Position{0, 0, static_cast<float>(0.5 * height)}));
}

// ---- Creases.

mesh::CornerNormals normals_of(const mesh::TriangleMesh& triangles, double crease) {
  return mesh::corner_normals(std::get<mesh::CheckedMesh>(mesh::check(triangles)), crease).normals;
}

// Inside a cube: up along its side until above the top, down again, and along the top.
TEST(usual_faults, a_crease_stays_a_crease_under_shading) {
  const mesh::TriangleMesh cube = mesh::cube(20);
  MeshSession sharp(built(cube, Sides::front, normals_of(cube, 30)), kStiffness, Shading::vertex_scheme),
      plain(built(cube, Sides::front), kStiffness, Shading::none),
      smooth(built(cube, Sides::front, normals_of(cube, 180)), kStiffness, Shading::vertex_scheme);
  for (MeshSession* session : {&sharp, &plain, &smooth}) session->tick({15, 1, 0});
  int on_side = 0, on_top = 0, is_free = 0, turned_by_shading = 0;
  for (int i = 0; i < 2150; ++i) {
    const float way = 0.01F * static_cast<float>(i);
    const Position p = i < 1050 ? Position{9, 1, way} : i < 1250 ? Position{9, 1, 21.0F - way} : Position{21.5F - way, 1, 8.5F};
    const mesh::Tick tick = sharp.tick(p), expected = plain.tick(p), turned = smooth.tick(p);
    ASSERT_EQ(tick.after, expected.after) << i;
    ASSERT_EQ(tick.force, expected.force) << i;
    const bool is_side = tick.force[0] > 0 && tick.force[1] == 0 && tick.force[2] == 0;
    const bool is_top = tick.force[0] == 0 && tick.force[1] == 0 && tick.force[2] > 0;
    ASSERT_TRUE(is_side || is_top || tick.force == Position{}) << i;
    on_side += is_side;
    on_top += is_top;
    is_free += tick.status == Status::free;
    turned_by_shading += turned.force != tick.force;
  }
  std::printf("  %d ticks on the side, %d on top, %d free; shading without the crease turned %d forces\n", on_side, on_top,
              is_free, turned_by_shading);
  EXPECT_GT(on_side, 900);
  EXPECT_GT(on_top, 900);
  EXPECT_GT(is_free, 50);
  EXPECT_GT(turned_by_shading, 900);
}

// A groove along the x axis with sides at 45 degrees: whoever is pressed into it stays at its bottom, and feels nothing along
// it.
TEST(usual_faults, a_groove_holds_the_god_object_at_its_bottom) {
  mesh::TriangleMesh groove;
  constexpr std::uint32_t kColumns = 40;
  for (std::uint32_t i = 0; i <= kColumns; ++i)
    for (const float y : {-20.0F, 0.0F, 20.0F}) groove.vertices.push_back({static_cast<float>(i) - 20, y, std::fabs(y)});
  for (std::uint32_t i = 0; i < kColumns; ++i)
    for (std::uint32_t row = 0; row < 2; ++row) {
      const std::uint32_t a = 3 * i + row;
      groove.triangles.push_back({a, a + 3, a + 4});
      groove.triangles.push_back({a, a + 4, a + 1});
    }
  MeshSession session(built(groove, Sides::both), kStiffness, Shading::none);
  session.tick({0.4F, 0.1F, 5});
  int at_edges = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    const Position p{static_cast<float>(15 * std::sin(3 * t)), static_cast<float>(0.9 * std::sin(40 * t)), -1};
    const mesh::Tick tick = session.tick(p);
    ASSERT_EQ(tick.status, Status::contact) << i;
    ASSERT_TRUE(tick.after.place == Place::edge || tick.after.place == Place::vertex) << i;
    at_edges += tick.after.place == Place::edge;
    if (tick.after.place == Place::edge) {
      ASSERT_EQ(tick.force, (Position{0, -kStiffness * p[1], kStiffness})) << i;
    }
  }
  EXPECT_GT(at_edges, 2900);
}

}  // namespace
}  // namespace forceshade
