// SPDX-License-Identifier: BSD-3-Clause
// The errata of reference/laws/errata.md on forces, one test per correction: the printed form breaks a demand that both of our sides
// keep.

#include "tests/laws/errata.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

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
using tests::errata::normal;
using tests::errata::ours;
using tests::errata::Side;
using tests::errata::slope_to_the_right;
using tests::errata::three_polygons;
using tests::errata::two_polygons;

constexpr Parameters kWholeDepth{.radius = 1.25F, .width = 1.5F, .stiffness = 0.5F};  // d = 1: its axis is a position

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

}  // namespace
}  // namespace forceshade
