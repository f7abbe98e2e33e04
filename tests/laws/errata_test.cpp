// SPDX-License-Identifier: BSD-3-Clause
// The errata of docs/errata.md, one test per correction: the printed form breaks a demand that both of our sides keep.
//
// A demand is a function of a force field. The printed form, written down here in binary64, and our fast and reference laws
// go through the same one, so a test fails when the printed form is right after all and when ours is wrong.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <variant>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Field = std::function<Vector3d(const Vector3f&)>;  // position, mm -> force, N

struct Side {
  const char* name;
  Field field;
};

std::array<Side, 2> ours(LawId id, const Parameters& p) {
  const auto fast_law = std::get<fast::Law>(fast::Law::build(id, p));
  const auto reference_law = std::get<reference::Law>(reference::Law::build(id, p));
  return {{{"fast", [=](const Vector3f& at) -> Vector3d { return fast_law.force(at).cast<double>(); }},
           {"reference",
            [=](const Vector3f& at) -> Vector3d { return reference_law.round_to_binary32(at).force.cast<double>(); }}}};
}

// Relative to a force's length: its components are rounded to binary32, and a little more for the binary64 of this file.
constexpr double kRounding = 0x1.01p-24;

bool is_close(const Vector3d& a, const Vector3d& b) {
  return (a - b).norm() <= kRounding * std::max(a.norm(), b.norm());
}
bool is_close(double a, double b) {
  return std::fabs(a - b) <= kRounding * std::max(std::fabs(a), std::fabs(b));
}

constexpr Parameters kBump{.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F};
constexpr Parameters kHalfCylinder{.radius = 12.7F, .width = 25.4F, .stiffness = 0.5F};  // w′/2 = R/2 is a binary32
constexpr Parameters kWholeDepth{.radius = 1.25F, .width = 1.5F, .stiffness = 0.5F};     // d = 1: its axis is a position

// The thesis's letters, as printed (4.2 to 4.4.3), in binary64.
struct Geometry {
  double R, w, K;           // mm, mm, N/mm
  double d, h;              // mm
  double alpha, theta;      // rad
  double w_prime, h_prime;  // mm

  explicit Geometry(const Parameters& p)
      : R(static_cast<double>(p.radius)),
        w(static_cast<double>(p.width)),
        K(static_cast<double>(p.stiffness)),
        d(std::sqrt(R * R - w * w / 4)),
        h(R - d),
        alpha(std::asin(w / (2 * R))),
        theta(2 * alpha / 3),
        w_prime(2 * (w / 2 * std::cos(theta) - d * std::sin(theta))),
        h_prime(w / 2 * std::sin(theta) + d * std::cos(theta) - d) {}
};

// A height map U(x); the y axis is a symmetry of all of them.
using HeightMap = std::function<double(double)>;

HeightMap two_polygons(const Geometry& g) {
  return [=](double x) { return std::fabs(x) <= g.w / 2 ? g.h * (1 - 2 * std::fabs(x) / g.w) : 0; };
}
HeightMap three_polygons(const Geometry& g) {
  return [=](double x) {
    const double ax = std::fabs(x);
    if (ax <= g.w_prime / 2) return g.h_prime;
    return ax <= g.w / 2 ? g.h_prime * (ax - g.w / 2) / (g.w_prime / 2 - g.w / 2) : 0;
  };
}
HeightMap cylinder_cap(const Geometry& g) {
  return [=](double x) { return std::fabs(x) <= g.w / 2 ? std::sqrt(g.R * g.R - x * x) - g.d : 0; };
}

// The one-sided slopes of U at x, mm/mm; good to 10^-6 on the maps above.
constexpr double kStep = 0x1p-20;
double slope_to_the_left(const HeightMap& U, double x) {
  return (U(x) - U(x - kStep)) / kStep;
}
double slope_to_the_right(const HeightMap& U, double x) {
  return (U(x + kStep) - U(x)) / kStep;
}

// The surface normal of 2.5.1.
Vector3d normal(double slope) {
  return Vector3d(-slope, 0, 1) / std::sqrt(1 + slope * slope);
}

// Distances above or below a surface, mm, increasing.
constexpr std::array<float, 7> kDistances{0x1p-30F, 0x1p-10F, 0.125F, 0.5F, 1, 2, 8};

// Off every kink of every bump here, on both sides, and beside the bump.
constexpr std::array<float, 7> kPlaces{-20, -9, -1.5F, 0.25F, 5, 12, 30};

// ---- 2.2.1

Field printed_wall(double k, const Vector3d& x0, const Vector3d& n) {
  return [=](const Vector3f& at) -> Vector3d {
    const double out = (at.cast<double>() - x0).dot(n);
    if (!(out >= 0)) return Vector3d::Zero();
    return k * out * n;
  };
}

bool leaves_a_free_hand_alone(const Field& field) {
  return std::ranges::all_of(kDistances, [&](float above) { return field({3, -2, above}) == Vector3d::Zero(); });
}

bool pushes_a_deeper_hand_out_harder(const Field& field) {
  double last = 0;
  for (const float depth : kDistances) {
    const Vector3d force = field({3, -2, -depth});
    if (!(force.z() > last && force.x() == 0 && force.y() == 0)) return false;
    last = force.z();
  }
  return true;
}

TEST(errata, printed_wall_pushes_a_free_hand_and_lets_it_fall_through) {
  const Field printed = printed_wall(static_cast<double>(kBump.stiffness), Vector3d::Zero(), Vector3d::UnitZ());
  EXPECT_FALSE(leaves_a_free_hand_alone(printed));
  EXPECT_FALSE(pushes_a_deeper_hand_out_harder(printed));
  for (const float distance : kDistances) {
    EXPECT_GT(printed({3, -2, distance}).z(), 0) << "in open air, " << distance << " mm above the wall";
    EXPECT_EQ(printed({3, -2, -distance}).norm(), 0) << distance << " mm inside the wall";
  }
  for (const Side& side : ours(LawId::wall, kBump)) {
    EXPECT_TRUE(leaves_a_free_hand_alone(side.field)) << side.name;
    EXPECT_TRUE(pushes_a_deeper_hand_out_harder(side.field)) << side.name;
  }
}

// ---- 2.2.2

// The vector from the axis, through the origin along A, to x_a.
using FromAxis = std::function<Vector3d(const Vector3d& x_a, const Vector3d& A)>;

Vector3d printed_from_axis(const Vector3d& x_a, const Vector3d& A) {
  return x_a - x_a.dot(A) * A;
}
Vector3d corrected_from_axis(const Vector3d& x_a, const Vector3d& A) {
  return x_a - x_a.dot(A) / A.dot(A) * A;
}

Field printed_cylinder(const Geometry& g, const Vector3d& A) {
  return [=](const Vector3f& at) -> Vector3d {
    const Vector3d l = printed_from_axis(at.cast<double>() + Vector3d(0, 0, g.d), A);
    if (!(l.norm() - g.R >= 0)) return Vector3d::Zero();
    return g.K * (l.norm() - g.R) * l / l.norm();
  };
}

// Sign and condition reversed; l is still to be chosen.
Field reversed_cylinder(const Geometry& g, const FromAxis& from_axis, const Vector3d& A) {
  return [=](const Vector3f& at) -> Vector3d {
    const Vector3d l = from_axis(at.cast<double>() + Vector3d(0, 0, g.d), A);
    if (!(l.norm() < g.R)) return Vector3d::Zero();
    return g.K * (g.R - l.norm()) * l / l.norm();
  };
}

// On circles about the axis, radii in units of R; the same ring at several places along the axis.
std::vector<Vector3f> rings(const Geometry& g, const std::vector<double>& radii) {
  std::vector<Vector3f> positions;
  for (const double radius : radii)
    for (int degrees = 15; degrees < 375; degrees += 30)
      for (const float y : {-3.0F, 0.0F, 7.0F}) {
        const double turn = degrees * std::acos(-1.0) / 180;
        positions.emplace_back(static_cast<float>(radius * g.R * std::cos(turn)), y,
                               static_cast<float>(radius * g.R * std::sin(turn) - g.d));
      }
  return positions;
}

bool is_free_outside_the_cylinder(const Field& field, const Geometry& g) {
  return std::ranges::all_of(rings(g, {1.01, 1.5, 4}), [&](const Vector3f& at) { return field(at) == Vector3d::Zero(); });
}

// With F = K(R - ρ) along the radius, the same all along the axis.
bool pushes_out_of_the_cylinder(const Field& field, const Geometry& g) {
  return std::ranges::all_of(rings(g, {0.01, 0.25, 0.5, 0.99}), [&](const Vector3f& at) {
    const Vector3d radius(static_cast<double>(at.x()), 0, static_cast<double>(at.z()) + g.d);
    return is_close(field(at), g.K * (g.R - radius.norm()) * radius.normalized());
  });
}

TEST(errata, printed_cylinder_pushes_outside_and_needs_a_unit_axis) {
  const Geometry g(kWholeDepth);
  const Field printed = printed_cylinder(g, Vector3d::UnitY());
  EXPECT_FALSE(is_free_outside_the_cylinder(printed, g));
  EXPECT_FALSE(pushes_out_of_the_cylinder(printed, g));
  for (const Vector3f& inside : rings(g, {0.25, 0.99})) EXPECT_EQ(printed(inside).norm(), 0);

  for (const double length : {0.5, 2.0, 3.0}) {
    const Vector3d A(0, length, 0);
    EXPECT_FALSE(pushes_out_of_the_cylinder(reversed_cylinder(g, printed_from_axis, A), g)) << "|A| = " << length;
    EXPECT_TRUE(pushes_out_of_the_cylinder(reversed_cylinder(g, corrected_from_axis, A), g)) << "|A| = " << length;
    EXPECT_TRUE(is_free_outside_the_cylinder(reversed_cylinder(g, corrected_from_axis, A), g)) << "|A| = " << length;
  }
  EXPECT_TRUE(pushes_out_of_the_cylinder(reversed_cylinder(g, printed_from_axis, Vector3d::UnitY()), g));

  const Vector3f on_axis(0, 0, static_cast<float>(-g.d));
  EXPECT_TRUE(reversed_cylinder(g, printed_from_axis, Vector3d::UnitY())(on_axis).hasNaN());

  for (const Side& side : ours(LawId::cylinder, kWholeDepth)) {
    EXPECT_TRUE(is_free_outside_the_cylinder(side.field, g)) << side.name;
    EXPECT_TRUE(pushes_out_of_the_cylinder(side.field, g)) << side.name;
    EXPECT_EQ(side.field(on_axis), Vector3d(0, 0, g.K * g.R)) << side.name;
  }
}

// ---- 2.5

using Indentation = std::function<double(const HeightMap& f, const Vector3f& at)>;

double printed_indentation(const HeightMap& f, const Vector3f& at) {
  return static_cast<double>(at.z()) - f(static_cast<double>(at.x()));
}
double corrected_indentation(const HeightMap& f, const Vector3f& at) {
  return -printed_indentation(f, at);
}

Vector3f above(const HeightMap& U, float x, double height) {
  return {x, 2, static_cast<float>(U(static_cast<double>(x)) + height)};
}

// The spring K·indentation along the normal, with no condition: 2.5 states the indentation before any.
Field spring(double K, const HeightMap& U, const Indentation& indentation) {
  return [=](const Vector3f& at) -> Vector3d {
    return K * indentation(U, at) * normal(slope_to_the_right(U, static_cast<double>(at.x())));
  };
}

// mJ that the hand receives while it is pressed straight down from the surface.
double energy_of_pressing(const Field& field, const HeightMap& U, float x, double depth) {
  constexpr int kPieces = 256;
  double energy = 0;
  for (int i = 0; i < kPieces; ++i) energy -= field(above(U, x, -depth * (i + 0.5) / kPieces)).z() * depth / kPieces;
  return energy;
}

bool pressing_in_costs_energy(const Field& field, const HeightMap& U) {
  return std::ranges::all_of(kPlaces, [&](float x) { return energy_of_pressing(field, U, x, 2) < 0; });
}

// K times the indentation is how hard the field pushes, and nothing is pushed where the indentation is not positive.
bool explains(const Indentation& indentation, double K, const HeightMap& U, const Field& field) {
  for (const float x : kPlaces)
    for (const float distance : {0.125F, 0.5F, 2.0F})
      for (const double height : {static_cast<double>(distance), -static_cast<double>(distance)}) {
        const Vector3f at = above(U, x, height);
        if (!is_close(field(at).norm(), K * std::max(0.0, indentation(U, at)))) return false;
      }
  return true;
}

TEST(errata, printed_indentation_has_the_wrong_sign) {
  const Geometry g(kBump);
  const HeightMap U = two_polygons(g);
  EXPECT_FALSE(pressing_in_costs_energy(spring(g.K, U, printed_indentation), U));
  EXPECT_TRUE(pressing_in_costs_energy(spring(g.K, U, corrected_indentation), U));
  for (const float x : kPlaces) {
    EXPECT_LT(printed_indentation(U, above(U, x, -1)), 0) << "1 mm inside";
    EXPECT_GT(printed_indentation(U, above(U, x, 1)), 0) << "1 mm outside";
  }
  for (const Side& side : ours(LawId::bump_2p, kBump)) {
    EXPECT_TRUE(pressing_in_costs_energy(side.field, U)) << side.name;
    EXPECT_FALSE(explains(printed_indentation, g.K, U, side.field)) << side.name;
    EXPECT_TRUE(explains(corrected_indentation, g.K, U, side.field)) << side.name;
  }
}

// ---- 2.5.1

Field printed_height_map(double K, const HeightMap& U) {
  return [=](const Vector3f& at) -> Vector3d {
    const double x = static_cast<double>(at.x()), z = static_cast<double>(at.z());
    if (!(std::fabs(U(x) - z) >= 0)) return Vector3d::Zero();
    return K * (U(x) - z) * normal(slope_to_the_right(U, x));
  };
}

bool never_pulls_a_hand_to_the_surface(const Field& field, const HeightMap& U) {
  for (const float x : kPlaces)
    for (const float distance : {0.125F, 0.5F, 2.0F, 50.0F}) {
      const Vector3d N = normal(slope_to_the_right(U, static_cast<double>(x)));
      if (field(above(U, x, static_cast<double>(distance))).dot(N) < 0) return false;
      if (field(above(U, x, -static_cast<double>(distance))).dot(N) <= 0) return false;
    }
  return true;
}

TEST(errata, printed_condition_makes_the_surface_sticky_from_outside) {
  const Geometry g(kBump);
  const HeightMap two = two_polygons(g), three = three_polygons(g);
  const Field printed = printed_height_map(g.K, two);
  EXPECT_FALSE(never_pulls_a_hand_to_the_surface(printed, two));
  EXPECT_FALSE(never_pulls_a_hand_to_the_surface(printed_height_map(g.K, three), three));
  EXPECT_TRUE(is_close(printed(above(two, 30, 50)), Vector3d(0, 0, -50 * g.K))) << "50 mm above the plane, towards it";
  for (const Side& side : ours(LawId::bump_2p, kBump))
    EXPECT_TRUE(never_pulls_a_hand_to_the_surface(side.field, two)) << side.name;
  for (const Side& side : ours(LawId::bump_3p, kBump))
    EXPECT_TRUE(never_pulls_a_hand_to_the_surface(side.field, three)) << side.name;
}

// ---- 3.2

Field printed_force_shading(double K, const HeightMap& U) {
  return [=](const Vector3f& at) -> Vector3d {
    const double x = static_cast<double>(at.x()), z = static_cast<double>(at.z());
    if (!(std::fabs(z) <= 0)) return Vector3d::Zero();
    return K * -z * normal(slope_to_the_right(U, x));
  };
}

// K times the depth below the flat plane, along the height map's normal.
bool answers_a_press_with_the_normal_of(const HeightMap& U, double K, const Field& field) {
  for (const float x : kPlaces)
    for (const float depth : kDistances) {
      const double size = K * static_cast<double>(depth);
      const Vector3d force = field({x, 2, -depth});
      if (!is_close(force.norm(), size)) return false;
      if ((force - size * normal(slope_to_the_right(U, static_cast<double>(x)))).norm() > 1e-6 * size) return false;
    }
  return true;
}

TEST(errata, printed_force_shading_is_zero_everywhere) {
  const Geometry g(kBump);
  const HeightMap cap = cylinder_cap(g);
  const Field printed = printed_force_shading(g.K, cap);
  EXPECT_FALSE(answers_a_press_with_the_normal_of(cap, g.K, printed));
  for (const float x : kPlaces) {
    EXPECT_EQ(printed({x, 2, 0}).norm(), 0) << "on the plane at x = " << x;
    for (const float distance : kDistances) {
      EXPECT_EQ(printed({x, 2, distance}).norm(), 0) << distance << " mm above the plane at x = " << x;
      EXPECT_EQ(printed({x, 2, -distance}).norm(), 0) << distance << " mm below the plane at x = " << x;
    }
  }
  for (const Side& side : ours(LawId::bump_1p_shaded, kBump))
    EXPECT_TRUE(answers_a_press_with_the_normal_of(cap, g.K, side.field)) << side.name;
}

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

// How far the normals of two faces lie apart on the edge they share, over all edges.
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
  bool left;  // whether the line belongs to the side of smaller x
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
