// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/passivity.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstdio>

#include "forceshade/properties/binary32.h"

namespace forceshade::properties {
namespace {

// Quadrature on pieces that are smooth: generous, and still below the rounding of any path of a millimetre.
constexpr double kQuadrature = 1e-9;

std::string loop_text(const std::vector<PathPoint>& vertices) {
  std::string text;
  for (const PathPoint& v : vertices) {
    char point[80];
    std::snprintf(point, sizeof point, "%s(%a, %a)", text.empty() ? "" : " ", v.x, v.z);
    text += point;
  }
  return text;
}

// The circulation density κ = ∂F_z/∂x - ∂F_x/∂z of a shaded bump at x > 0 and depth δ under its nominal surface is
// K x/R·(1 - δ/√(R² - x²)) - K g√(R² - x²)/R with g = -dH/dx: positive above the depth q(x), negative below it.
struct ShadedDensity {
  const Shape& shape;

  double slope(double x) const {
    if (shape.id == LawId::bump_1p_shaded) return 0;
    if (shape.id == LawId::bump_3p_shaded && x <= static_cast<double>(shape.w_prime / 2)) return 0;
    return static_cast<double>(shape.steepest);
  }
  double root(double x) const {
    const auto R = static_cast<double>(shape.R);
    return std::sqrt((R - x) * (R + x));
  }
  double sign_change_depth(double x) const {
    return x > 0 ? root(x) * (1 - slope(x) * root(x) / x) : (slope(x) > 0 ? -HUGE_VAL : root(x));
  }
  // ∫ κ dδ from 0 to `depth` at x.
  double column(double x, double depth) const {
    const auto R = static_cast<double>(shape.R), K = static_cast<double>(shape.K);
    return K / R * ((x - slope(x) * root(x)) * depth - (root(x) > 0 ? x / root(x) : 0) * depth * depth / 2);
  }
};

// x from `from` to `to`, the first a little inside so that it is on the piece's own side of a kink; closer and closer
// towards `to`, where the edge of a half cylinder falls off like a root.
std::vector<double> grid(double from, double to) {
  constexpr int kSteps = 2000;
  std::vector<double> x;
  const double start = from > 0 ? from * (1 + 1e-12) : 0;
  for (int i = kSteps; i >= 0; --i)
    x.push_back(to - (to - start) * (static_cast<double>(i) * i) / (static_cast<double>(kSteps) * kSteps));
  return x;
}

WitnessLoop shaded_witness(const Shape& shape, double depth) {
  const ShadedDensity density{shape};
  const auto half = static_cast<double>(shape.w / 2), R = static_cast<double>(shape.R), K = static_cast<double>(shape.K);
  const auto split = [&](double x) { return std::clamp(density.sign_change_depth(x), 0.0, depth); };
  const auto surface = [&](double x) { return static_cast<double>(shape.surface(static_cast<long double>(x))); };
  const double top = shape.id == LawId::bump_3p_shaded ? static_cast<double>(shape.w_prime / 2) : 0;
  std::vector<std::vector<double>> pieces;
  if (top > 0) pieces.push_back(grid(0, top));
  pieces.push_back(grid(top, half));

  // A⁺ = ∬κ⁺ and the line at w/2; A⁻ = ∬κ⁻.
  double positive = 0.5 * K * depth * depth * (1 - static_cast<double>(shape.d) / R), negative = 0;
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  for (const std::vector<double>& piece : pieces) {
    const auto above = [&](double x) { return density.column(x, split(x)); };
    const auto below = [&](double x) { return density.column(x, split(x)) - density.column(x, depth); };
    positive += Rule::integrate(above, piece.front(), piece.back(), 12, 1e-10);
    negative += Rule::integrate(below, piece.front(), piece.back(), 12, 1e-10);
  }

  // A⁺: outward along the lower edge of the positive region, down the line's inner side to the full depth, up just outside
  // it, back above the surface.
  // A⁻: outward along the same edge, back along the full depth.
  const auto beyond = static_cast<double>(neighbour(static_cast<float>(shape.w / 2), 1));
  const bool is_positive = positive >= negative;
  WitnessLoop loop{{}, std::max(positive, negative)};
  for (const std::vector<double>& piece : pieces)
    for (const double x : piece) loop.vertices.push_back({x, surface(x) - split(x)});
  if (is_positive) {
    loop.vertices.push_back({half, -depth});
    loop.vertices.push_back({beyond, -depth});
    loop.vertices.push_back({beyond, depth / 16});
  }
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
    for (auto x = piece->rbegin(); x != piece->rend(); ++x)
      loop.vertices.push_back({*x, surface(*x) + (is_positive ? depth / 16 : -depth)});
  return loop;
}

// Up one side of a line on which F_z jumps and down the other, over the whole depth.
std::vector<PathPoint> along_line(double left, double right, double height, double depth, bool right_is_paid) {
  std::vector<PathPoint> loop{{right, height - depth}, {right, height}, {left, height}, {left, height - depth}};
  if (!right_is_paid) std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace

Violation passivity(const Subject& subject, const Shape& shape, const std::vector<PathPoint>& vertices) {
  const Work work = work_around(subject, shape, vertices);
  const double allowed = (shape.is_conservative() ? work.placing + kQuadrature : work.exact) + work.rounding * (1 + 1e-9);
  if (work.rendered <= allowed + 1e-15) return std::nullopt;
  char numbers[200];
  std::snprintf(numbers, sizeof numbers, "gives %.9g mJ to the hand; the exact law gives %.9g mJ and rounding may add %.3g mJ",
                work.rendered, shape.is_conservative() ? 0.0 : work.exact, work.rounding);
  return "the closed path " + loop_text(vertices) + " mm " + numbers;
}

WitnessLoop witness_loop(const Shape& shape, double depth) {
  const auto K = static_cast<double>(shape.K);
  const auto half = static_cast<float>(shape.w / 2);
  if (!shape.is_conservative() && half >= 1e4F) return {};
  switch (shape.id) {
    case LawId::wall:
    case LawId::bump_1p: return {{{-5, -depth}, {5, -depth}, {3, 1}, {-4, 1}}, 0};
    case LawId::cylinder:
    case LawId::bump_cylinder: {
      const auto h = static_cast<double>(shape.h), w = static_cast<double>(shape.w);
      return {{{-w / 4, h - depth}, {w / 4, h - depth}, {w / 8, h + 1}, {-w / 8, h + 1}}, 0};
    }
    case LawId::bump_2p:
      return {along_line(static_cast<double>(half), static_cast<double>(neighbour(half, 1)), 0, depth, true),
              0.5 * K * depth * depth * (1 - std::cos(static_cast<double>(shape.alpha) / 2))};
    case LawId::bump_3p:
      return {along_line(static_cast<double>(half), static_cast<double>(neighbour(half, 1)), 0, depth, true),
              0.5 * K * depth * depth * (1 - std::cos(static_cast<double>(shape.theta)))};
    case LawId::bump_1p_shaded:
    case LawId::bump_2p_shaded:
    case LawId::bump_3p_shaded: return shaded_witness(shape, depth);
  }
  return {};
}

Violation witness_is_reached(const Subject& subject, const Shape& shape, double depth) {
  const WitnessLoop loop = witness_loop(shape, depth);
  const Work work = work_around(subject, shape, loop.vertices);
  const double allowed = work.rounding + work.placing + kQuadrature + 1e-4 * loop.listed_mJ;
  if (std::fabs(work.rendered - loop.listed_mJ) <= allowed) return std::nullopt;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "expected %.6g mJ within %.2g mJ, got %.6g mJ", loop.listed_mJ, allowed,
                work.rendered);
  return std::string("the loop of depth ") + std::to_string(depth) + " mm that should be paid most: " + numbers;
}

}  // namespace forceshade::properties
