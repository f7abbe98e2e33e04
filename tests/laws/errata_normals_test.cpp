// SPDX-License-Identifier: BSD-3-Clause
// The errata of reference/laws/errata.md on normals: where faces meet, the printed one is short, jumps or is not defined.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "forceshade/fast.h"
#include "tests/laws/errata.h"

namespace forceshade {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using tests::errata::cylinder_cap;
using tests::errata::Field;
using tests::errata::Geometry;
using tests::errata::HeightMap;
using tests::errata::is_close;
using tests::errata::kBump;
using tests::errata::kHalfCylinder;
using tests::errata::normal;
using tests::errata::ours;
using tests::errata::Side;
using tests::errata::slope_to_the_left;
using tests::errata::slope_to_the_right;
using tests::errata::three_polygons;
using tests::errata::two_polygons;

// ---- 4.4.2

// bump-2p with the x direction of the normal as a function of x: the printed one is sgn.
Field two_polygon_bump(const Geometry& g, const std::function<Vector3d(double)>& direction) {
  return [=, U = two_polygons(g)](const Vector3f& at) -> Vector3d {
    const double x = static_cast<double>(at.x()), gap = U(x) - static_cast<double>(at.z());
    if (!(gap > 0)) return Vector3d::Zero();
    return g.K * gap * direction(x);
  };
}

bool has_its_full_length_on_the_ridge(const Field& field, const Geometry& g) {
  return std::ranges::all_of(std::array{0.125, 0.5, 2.0, 20.0}, [&](double depth) {
    const auto z = static_cast<float>(g.h - depth);
    return is_close(field({0, 2, z}).norm(), g.K * (g.h - static_cast<double>(z)));
  });
}

// mJ given to a hand that rises along the ridge from `depth` to the surface and sinks again a picometre to its right. The
// two level pieces are a picometre long.
double energy_along_the_ridge(const Field& field, const Geometry& g, double depth) {
  constexpr int kPieces = 256;
  constexpr float kBeside = 0x1p-30F;
  double energy = 0;
  for (int i = 0; i < kPieces; ++i) {
    const auto z = static_cast<float>(g.h - depth * (i + 0.5) / kPieces);
    energy += (field({0, 2, z}).z() - field({kBeside, 2, z}).z()) * depth / kPieces;
  }
  const auto bottom = static_cast<float>(g.h - depth);
  energy -= field({kBeside, 2, bottom}).x() * static_cast<double>(kBeside);
  return energy;
}

TEST(errata, printed_sign_of_zero_gives_a_short_normal_on_the_ridge) {
  const Geometry g(kBump);
  const double slope = 2 * g.h / g.w;
  const auto sgn = [](double x) { return static_cast<double>((x > 0) - (x < 0)); };
  const auto face = [=](double sign) -> Vector3d { return Vector3d(slope * sign, 0, 1) / std::sqrt(1 + slope * slope); };
  const Field printed = two_polygon_bump(g, [=](double x) { return face(sgn(x)); });
  const Field upright = two_polygon_bump(g, [=](double x) -> Vector3d { return x == 0 ? Vector3d::UnitZ() : face(sgn(x)); });

  EXPECT_FALSE(has_its_full_length_on_the_ridge(printed, g));
  EXPECT_TRUE(is_close(face(sgn(0)).norm(), std::cos(g.alpha / 2)));
  EXPECT_LT(std::cos(g.alpha / 2), 0.9);
  EXPECT_TRUE(has_its_full_length_on_the_ridge(upright, g));

  // With a unit normal straight up, every stroke along the ridge generates energy; with ours none does.
  constexpr double kDepth = 2;
  const double listed = 0.5 * g.K * kDepth * kDepth * (1 - std::cos(g.alpha / 2));
  const double rounding = 0x1p-22 * g.K * kDepth * kDepth;
  EXPECT_NEAR(energy_along_the_ridge(upright, g, kDepth), listed, rounding);
  EXPECT_GT(listed, 1000 * rounding);
  EXPECT_NEAR(energy_along_the_ridge(printed, g, kDepth), 0, rounding) << "too short, but it generates nothing";
  for (const Side& side : ours(LawId::bump_2p, kBump)) {
    EXPECT_TRUE(has_its_full_length_on_the_ridge(side.field, g)) << side.name;
    EXPECT_NEAR(energy_along_the_ridge(side.field, g, kDepth), 0, rounding) << side.name;
  }
}

// ---- 3.3. The mesh law is later work; what is tested here is the scheme it would interpolate its normals by.

struct Octahedron {
  std::vector<Vector3d> vertices{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<std::array<std::size_t, 3>> faces;

  Octahedron() {
    for (const std::size_t x : {0U, 3U})
      for (const std::size_t y : {1U, 4U})
        for (const std::size_t z : {2U, 5U}) faces.push_back({x, y, z});
  }

  // Outwards: the centre is the origin.
  Vector3d normal_of(std::size_t face) const {
    const auto& [a, b, c] = faces[face];
    const Vector3d n = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).normalized();
    return n.dot(vertices[a]) > 0 ? n : -n;
  }

  bool has(std::size_t face, std::size_t vertex) const { return std::ranges::count(faces[face], vertex) > 0; }

  // Edge i is the one opposite the face's vertex i.
  std::array<std::size_t, 2> ends(std::size_t face, std::size_t edge) const {
    return {faces[face][(edge + 1) % 3], faces[face][(edge + 2) % 3]};
  }
  std::size_t neighbour(std::size_t face, std::size_t edge) const {
    const auto [a, b] = ends(face, edge);
    for (std::size_t other = 0; other < faces.size(); ++other)
      if (other != face && has(other, a) && has(other, b)) return other;
    return face;
  }
};

// N(x) of 3.3 as printed.
Vector3d printed_edge_scheme(const Octahedron& mesh, std::size_t face, const Vector3d& at) {
  std::array<Vector3d, 3> mean;
  std::array<double, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [a, b] = mesh.ends(face, i);
    const Vector3d along = (mesh.vertices[b] - mesh.vertices[a]).normalized();
    x[i] = (at - mesh.vertices[a]).cross(along).norm();
    mean[i] = (mesh.normal_of(face) + mesh.normal_of(mesh.neighbour(face, i))) / 2;
  }
  return (x[0] * (mean[1] + mean[2]) + x[1] * (mean[0] + mean[2]) + x[2] * (mean[0] + mean[1])) / (2 * (x[0] + x[1] + x[2]));
}

// The mean of the face normals at each vertex, interpolated barycentrically.
Vector3d vertex_scheme(const Octahedron& mesh, std::size_t face, const Vector3d& at) {
  Eigen::Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.col(i) = mesh.vertices[mesh.faces[face][static_cast<std::size_t>(i)]];
  const Vector3d weights = corners.inverse() * at;
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    Vector3d at_vertex = Vector3d::Zero();
    for (std::size_t other = 0; other < mesh.faces.size(); ++other)
      if (mesh.has(other, mesh.faces[face][static_cast<std::size_t>(i)])) at_vertex += mesh.normal_of(other);
    sum += weights[i] * at_vertex.normalized();
  }
  return sum.normalized();
}

struct Range {
  double smallest = HUGE_VAL, largest = 0;

  void add(double value) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
};

// The distances between the normals of two faces on the edge they share, over all edges.
template <class Scheme>
Range jumps_along_edges(const Octahedron& mesh, const Scheme& scheme) {
  Range jumps;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    for (std::size_t edge = 0; edge < 3; ++edge)
      for (int step = 0; step <= 8; ++step) {
        const auto [a, b] = mesh.ends(face, edge);
        const Vector3d at = mesh.vertices[a] + step / 8.0 * (mesh.vertices[b] - mesh.vertices[a]);
        jumps.add((scheme(mesh, face, at) - scheme(mesh, mesh.neighbour(face, edge), at)).norm());
      }
  return jumps;
}

TEST(errata, printed_edge_scheme_jumps_along_a_shared_edge) {
  const Octahedron mesh;
  const auto normalised = [](const Octahedron& m, std::size_t face, const Vector3d& at) -> Vector3d {
    return printed_edge_scheme(m, face, at).normalized();
  };
  const Range jumps = jumps_along_edges(mesh, normalised);
  EXPECT_NEAR(jumps.largest, 0.85, 0.005);
  EXPECT_NEAR(jumps.largest, 2 / std::sqrt(5.5), 1e-12) << "in the middle of an edge";
  EXPECT_NEAR(jumps.smallest, 2 / std::sqrt(6.0), 1e-12) << "at its ends";

  Range lengths;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const auto& [a, b, c] = mesh.faces[face];
    lengths.add(printed_edge_scheme(mesh, face, (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3).norm());
    lengths.add(printed_edge_scheme(mesh, face, (mesh.vertices[a] + mesh.vertices[b]) / 2).norm());
  }
  EXPECT_LT(lengths.largest, 0.7) << "not a unit normal";

  EXPECT_LT(jumps_along_edges(mesh, vertex_scheme).largest, 1e-14);
}

// ---- 2.5 and 3.2

struct Kink {
  LawId law;
  Parameters parameters;
  HeightMap U;
  float x;
  bool left;  // true if the line belongs to the side of smaller x
};

TEST(errata, kinks_have_no_normal_without_a_convention) {
  const Geometry bump(kBump), half(kHalfCylinder);
  const float edge = kBump.width / 2, top = kHalfCylinder.radius / 2;
  ASSERT_NEAR(static_cast<double>(top), half.w_prime / 2, 1e-14);
  const std::vector<Kink> kinks{
      {LawId::bump_2p, kBump, two_polygons(bump), 0, false},
      {LawId::bump_2p, kBump, two_polygons(bump), edge, true},
      {LawId::bump_2p, kBump, two_polygons(bump), -edge, false},
      {LawId::bump_3p, kBump, three_polygons(bump), edge, true},
      {LawId::bump_3p, kBump, three_polygons(bump), -edge, false},
      {LawId::bump_3p, kHalfCylinder, three_polygons(half), top, true},
      {LawId::bump_3p, kHalfCylinder, three_polygons(half), -top, false},
      {LawId::bump_1p_shaded, kBump, cylinder_cap(bump), edge, true},
      {LawId::bump_1p_shaded, kBump, cylinder_cap(bump), -edge, false},
  };
  for (const Kink& kink : kinks) {
    const double x = static_cast<double>(kink.x);
    const Vector3d from_left = normal(slope_to_the_left(kink.U, x)), from_right = normal(slope_to_the_right(kink.U, x));
    EXPECT_GT((from_left - from_right).norm(), 0.4) << name_of(kink.law) << " at x = " << kink.x;

    const float beside_left = kink.x == 0 ? -0x1p-30F : std::nextafter(kink.x, -HUGE_VALF);
    const float beside_right = kink.x == 0 ? 0x1p-30F : std::nextafter(kink.x, HUGE_VALF);
    for (const Side& side : ours(kink.law, kink.parameters)) {
      const auto direction = [&](float at) -> Vector3d { return side.field({at, 2, -1}).normalized(); };
      constexpr double kTolerance = 2e-6;  // of the one-sided slopes and the cylinder's normal one step away
      EXPECT_LT((direction(beside_left) - from_left).norm(), kTolerance) << side.name << ' ' << name_of(kink.law);
      EXPECT_LT((direction(beside_right) - from_right).norm(), kTolerance) << side.name << ' ' << name_of(kink.law);
      EXPECT_LT((direction(kink.x) - (kink.left ? from_left : from_right)).norm(), kTolerance)
          << side.name << ' ' << name_of(kink.law) << " at x = " << kink.x;
    }
  }
}

}  // namespace
}  // namespace forceshade
