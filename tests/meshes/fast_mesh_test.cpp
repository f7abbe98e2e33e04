// SPDX-License-Identifier: BSD-3-Clause
// The layout of a mesh for the real-time path: its joins, its tree, its numbering, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "fast/meshes/decide.h"
#include "fast/meshes/grid_point.h"
#include "fast/meshes/mesh.h"
#include "properties/mesh_path.h"
#include "tests/meshes/rendering.h"
#include "tests/support/mesh_source.h"

namespace forceshade::fast {
namespace {

Mesh built(const mesh::TriangleMesh& triangles) {
  return tests::fast_mesh(tests::unshaded(triangles, mesh::Sides::both));
}

TEST(fast_mesh, joins_the_triangles_as_their_vertices_say) {
  tests::MeshSource source(5);
  std::size_t rims = 0, joined = 0, narrow = 0, flat = 0, wide = 0;
  for (int i = 0; i < 60; ++i) {
    const tests::RandomMesh made = source.next();
    const Mesh mesh = built(made.mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> halves;
    for (const mesh::Triangle& t : made.mesh.triangles)
      for (std::size_t c = 0; c < 3; ++c) ++halves[{t[c], t[(c + 1) % 3]}];
    for (HalfEdge h = 0; h < 3 * mesh.faces(); ++h) {
      const std::uint32_t a = mesh.start(h), b = mesh.start(next(h));
      ASSERT_EQ((halves[{a, b}]), 1);
      const HalfEdge other = mesh.twin(h);
      ASSERT_EQ(other == kRim, (halves.count({b, a}) == 0));
      if (other == kRim) {
        ++rims;
        ASSERT_TRUE(mesh.is_at_rim(a) && mesh.is_at_rim(b));
        continue;
      }
      ++joined;
      ASSERT_EQ(mesh.twin(other), h);
      ASSERT_EQ(mesh.start(other), b);
      const Fold angle = mesh.face(face_of(h)).fold(corner_of(h));
      ASSERT_EQ(angle, mesh.face(face_of(other)).fold(corner_of(other)));
      const int sign = exact_side_of(mesh.face(face_of(h)), mesh.start_point(previous(other)));
      ASSERT_EQ(angle, sign > 0 ? Fold::narrow : sign == 0 ? Fold::flat : Fold::wide);
      (angle == Fold::narrow ? narrow : angle == Fold::flat ? flat : wide) += 1;
    }
    for (std::uint32_t t = 0; t < mesh.faces(); ++t) {
      ASSERT_EQ(mesh.face(mesh.face_of_file(t)).index(), t);
      ASSERT_EQ(mesh.face(mesh.face_of_file(t)).vertex, made.mesh.triangles[t]);
    }
    ASSERT_LE(mesh.bytes(), 84 * mesh.faces() + 4 * made.mesh.vertices.size() + 512);
  }
  std::printf("  %zu halves at the rim, %zu joined: %zu narrow, %zu flat, %zu wide\n", rims, joined, narrow, flat, wide);
  for (const std::size_t count : {rims, narrow, flat, wide}) EXPECT_GT(count, 100U);
}

TEST(fast_mesh, turns_states_into_its_own_numbers_and_back) {
  tests::MeshSource source(6);
  std::size_t edges = 0;
  for (int i = 0; i < 33; ++i) {
    const tests::RandomMesh made = source.next();
    const Mesh mesh = built(made.mesh);
    for (std::uint32_t t = 0; t < made.mesh.triangles.size(); ++t) {
      const mesh::Triangle& corners = made.mesh.triangles[t];
      mesh::GodObject object{mesh::Place::triangle, mesh::Side::back, false, {}, {t, 0}, {5, 7}};
      ASSERT_EQ(object_of(mesh, grid_point_of(mesh, object)), object);
      object = {mesh::Place::vertex, mesh::Side::front, false, {}, {corners[0], 0}, {}};
      ASSERT_EQ(object_of(mesh, grid_point_of(mesh, object)), object);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [a, b] = std::minmax(corners[c], corners[(c + 1) % 3]);
        object = {mesh::Place::edge, mesh::Side::front, false, {}, {a, b}, {3, 0}};
        ASSERT_EQ(object_of(mesh, grid_point_of(mesh, object)), object);
        ++edges;
      }
    }
    const auto count = static_cast<std::uint32_t>(made.mesh.vertices.size());
    for (const mesh::GodObject& wrong :
         {mesh::GodObject{mesh::Place::vertex, mesh::Side::front, false, {}, {count, 0}, {}},
          mesh::GodObject{mesh::Place::triangle, mesh::Side::front, false, {}, {mesh.faces(), 0}, {1, 1}},
          mesh::GodObject{mesh::Place::triangle, mesh::Side::front, false, {}, {0, 0}, {kGrid - 1, 1}},
          mesh::GodObject{mesh::Place::triangle, mesh::Side::front, false, {}, {0, 0}, {0, 1}},
          mesh::GodObject{mesh::Place::edge, mesh::Side::front, false, {}, {0, count}, {1, 0}},
          mesh::GodObject{mesh::Place::edge, mesh::Side::front, false, {}, {0, 1}, {kGrid, 0}}})
      ASSERT_EQ(grid_point_of(mesh, wrong).place, mesh::Place::nowhere);
  }
  EXPECT_GT(edges, 1000U);
}

// The tree visits all that a segment meets, by a test of boxes alone.
TEST(fast_mesh, has_a_tree_that_leaves_out_nothing_on_the_way) {
  tests::MeshSource source(7);
  std::size_t met = 0, visited_in_all = 0, all = 0;
  for (int i = 0; i < 66; ++i) {
    const tests::RandomMesh made = source.next();
    const Mesh mesh = built(made.mesh);
    properties::MeshPath path(made.mesh, static_cast<std::uint64_t>(i));
    std::array<float, 3> last{};
    for (int k = 0; k < 60; ++k) {
      const std::array<float, 3> p = path.next();
      if (!(std::fabs(p[0]) <= 1e4F && std::fabs(p[1]) <= 1e4F && std::fabs(p[2]) <= 1e4F)) continue;
      const auto place = [](const std::array<float, 3>& a) {
        return Vector3<double>{static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
      };
      std::set<std::uint32_t> visited;
      mesh.tree().along(place(last), place(p), [&](std::uint32_t f) { ASSERT_TRUE(visited.insert(f).second); });
      visited_in_all += visited.size();
      all += mesh.faces();
      // Points of the segment that are in a triangle's box: 200 of them, and the ends.
      for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        const auto& corner = mesh.face(f).corner;
        bool is_met = false;
        for (int step = 0; step <= 200 && !is_met; ++step) {
          is_met = true;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] = std::minmax({corner[0][axis], corner[1][axis], corner[2][axis]});
            const double at = static_cast<double>(last[axis]) +
                              step / 200.0 * (static_cast<double>(p[axis]) - static_cast<double>(last[axis]));
            is_met = is_met && at >= static_cast<double>(low) && at <= static_cast<double>(high);
          }
        }
        met += is_met;
        ASSERT_TRUE(!is_met || visited.count(f) == 1);
      }
      // No triangle is nearer than the distance that the tree gives.
      const auto least_square_of = [&](std::uint32_t f) {
        double least = 1e10;
        for (const auto& corner : mesh.face(f).corner) {
          double sum = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
            sum += std::pow(static_cast<double>(corner[axis]) - static_cast<double>(p[axis]), 2);
          least = std::min(least, sum);
        }
        return least;
      };
      BoxTree::Search search;
      mesh.tree().begin(search, place(p), 1e10);
      while (!search.is_done()) mesh.tree().advance(search, 1 + k % 5, least_square_of);
      double nearest = 1e10;
      for (const auto& face : mesh.all_faces())
        for (const auto& corner : face.corner) {
          double sum = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
            sum += std::pow(static_cast<double>(corner[axis]) - static_cast<double>(p[axis]), 2);
          nearest = std::min(nearest, sum);
        }
      ASSERT_LE(search.square(), nearest);
      ASSERT_GE(search.square(), 0.499 * nearest);
      last = p;
    }
  }
  std::printf("  %zu boxes met, %zu triangles visited of %zu\n", met, visited_in_all, all);
  EXPECT_GT(met, 1000U);
  EXPECT_LT(visited_in_all, all / 2);
}

// A cone whose apex has as many triangles as the mesh: joining it takes no longer than joining others.
TEST(fast_mesh, joins_a_vertex_with_ten_thousand_triangles) {
  constexpr std::uint32_t kSides = 10000;
  mesh::TriangleMesh cone{{{0, 0, 1}}, {}};
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * 3.14159265358979 * i / kSides;
    cone.vertices.push_back({static_cast<float>(1000 * std::cos(angle)), static_cast<float>(1000 * std::sin(angle)), 0});
    cone.triangles.push_back({0, 1 + i, 1 + (i + 1) % kSides});
  }
  const Mesh mesh = built(cone);
  EXPECT_FALSE(mesh.is_at_rim(0));
  EXPECT_TRUE(mesh.is_at_rim(1));
}

}  // namespace
}  // namespace forceshade::fast
