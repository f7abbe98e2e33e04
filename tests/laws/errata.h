// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that the tests of the thesis's errata share: our laws as force fields, and the thesis's letters and height maps.
//
// A demand is a function of a force field. The printed form, written down in these tests in binary64, and our fast and
// reference laws go through the same one, so a test fails when the printed form is right after all and when ours is wrong.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <variant>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::tests::errata {

using Eigen::Vector3d;
using Eigen::Vector3f;

using Field = std::function<Vector3d(const Vector3f&)>;  // position, mm -> force, N

struct Side {
  const char* name;
  Field field;
};

inline std::array<Side, 2> ours(LawId id, const Parameters& p) {
  const auto fast_law = std::get<fast::Law>(fast::Law::build(id, p));
  const auto reference_law = std::get<reference::Law>(reference::Law::build(id, p));
  return {{{"fast", [=](const Vector3f& at) -> Vector3d { return fast_law.force(at).cast<double>(); }},
           {"reference",
            [=](const Vector3f& at) -> Vector3d { return reference_law.round_to_binary32(at).force.cast<double>(); }}}};
}

// Relative to a force's length: its components are rounded to binary32, and a little more for the binary64 of these tests.
inline constexpr double kRounding = 0x1.01p-24;

inline bool is_close(const Vector3d& a, const Vector3d& b) {
  return (a - b).norm() <= kRounding * std::max(a.norm(), b.norm());
}
inline bool is_close(double a, double b) {
  return std::fabs(a - b) <= kRounding * std::max(std::fabs(a), std::fabs(b));
}

inline constexpr Parameters kBump{.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F};
inline constexpr Parameters kHalfCylinder{.radius = 12.7F, .width = 25.4F, .stiffness = 0.5F};  // w′/2 = R/2 is a binary32

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

inline HeightMap two_polygons(const Geometry& g) {
  return [=](double x) { return std::fabs(x) <= g.w / 2 ? g.h * (1 - 2 * std::fabs(x) / g.w) : 0; };
}
inline HeightMap three_polygons(const Geometry& g) {
  return [=](double x) {
    const double ax = std::fabs(x);
    if (ax <= g.w_prime / 2) return g.h_prime;
    return ax <= g.w / 2 ? g.h_prime * (ax - g.w / 2) / (g.w_prime / 2 - g.w / 2) : 0;
  };
}
inline HeightMap cylinder_cap(const Geometry& g) {
  return [=](double x) { return std::fabs(x) <= g.w / 2 ? std::sqrt(g.R * g.R - x * x) - g.d : 0; };
}

// The one-sided slopes of U at x, mm/mm; good to 10^-6 on the maps above.
inline constexpr double kStep = 0x1p-20;
inline double slope_to_the_left(const HeightMap& U, double x) {
  return (U(x) - U(x - kStep)) / kStep;
}
inline double slope_to_the_right(const HeightMap& U, double x) {
  return (U(x + kStep) - U(x)) / kStep;
}

// The surface normal of 2.5.1.
inline Vector3d normal(double slope) {
  return Vector3d(-slope, 0, 1) / std::sqrt(1 + slope * slope);
}

}  // namespace forceshade::tests::errata
