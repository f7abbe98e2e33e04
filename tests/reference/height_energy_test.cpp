// SPDX-License-Identifier: BSD-3-Clause
#include "reference/height_energy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "reference/energy.h"
#include "tests/height_maps/height_examples.h"

namespace forceshade::reference {
namespace {

using height::Mode;
using Along = Slice::Along;
using Eigen::Vector3f;
using Path = std::vector<Vector3f>;

HeightMapField build(HeightMap map, Mode mode, float stiffness = 1) {
  return std::get<HeightMapField>(HeightMapField::build(std::move(map), mode, stiffness));
}

double low(const Interval& value) {
  return value.low.convert_to<double>();
}

double width(const Interval& value) {
  return Multiprecision(value.high - value.low).convert_to<double>();
}

// Encloses it, to 10^-7 of the larger of both senses.
void expect_near(const Interval& enclosed, double expected, double larger, const std::string& what) {
  EXPECT_GE(width(enclosed), 0) << what;
  EXPECT_LE(width(enclosed), 1e-7 * larger) << what;
  EXPECT_NEAR(low(enclosed), expected, 1e-7 * larger) << what;
}
void expect_near(const Interval& enclosed, double expected, const std::string& what) {
  expect_near(enclosed, expected, expected, what);
}

TEST(height_energy, only_planes_and_the_gradient_have_a_potential) {
  const auto of = [](const HeightMap& map, Mode mode) { return potential(build(map, mode)).value_or("none"); };
  const HeightMap hill{{{height::Gaussian{0, 0, 1, 2}}}}, slope{{{height::Plane{0.5F, 0, 1}}}},
      level{{{height::Plane{0.5F, -1, 1}}, {height::Plane{0.5F, -1, 0}, true}, {height::Grating{1, 0, 0, 1}}}},
      plate{{{std::make_shared<height::Grid>(
          height::Grid{2, 2, 1, height::Edge::clamp, height::Interpolant::cubic_spline, {3, 3, 3, 3}})}}},
      step{{{std::make_shared<height::Grid>(
          height::Grid{2, 2, 1, height::Edge::clamp, height::Interpolant::cubic_spline, {3, 3, 3, 4}})}}};
  for (const HeightMap& map : {hill, slope, level, plate, step})
    EXPECT_EQ(of(map, Mode::conservative), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of(hill, Mode::true_height), "none");
  EXPECT_EQ(of(step, Mode::true_height), "none");
  EXPECT_EQ(of(slope, Mode::true_height),
            "K/2 max(0, U(x, y) - z)^2 / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere");
  EXPECT_EQ(of(level, Mode::true_height), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of(hill, Mode::force_shaded), "none");
  EXPECT_EQ(of(slope, Mode::force_shaded), "none") << "sideways force that grows with the depth below the flat plane";
  EXPECT_EQ(of(level, Mode::force_shaded), "K/2 max(0, -z)^2");
  EXPECT_EQ(of(plate, Mode::force_shaded), "K/2 max(0, -z)^2");

  const height::Polygons ridge{{{-1, 0}, {0, 1}, {1, 0}}}, shelf{{{-1, 2}, {1, 2}}};
  EXPECT_EQ(of({{{ridge}}}, Mode::true_height), "none");
  EXPECT_EQ(of({{{shelf}}}, Mode::true_height), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of({{{shelf}}, {{ridge}}}, Mode::force_shaded), "none") << "a normal that stays, a depth that does not";
  EXPECT_EQ(of({{{shelf}}, {{shelf}}}, Mode::force_shaded), "K/2 max(0, S(x, y) - z)^2");
  EXPECT_EQ(of({slope.parts, slope.parts}, Mode::force_shaded),
            "K/2 max(0, S(x, y) - z)^2 / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere");
  const HeightMap lifted{slope.parts, {{height::Plane{0.5F, 0, 3}}}}, crossed{slope.parts, {{height::Plane{0.25F, 0, 3}}}};
  EXPECT_EQ(of(lifted, Mode::force_shaded),
            "K/2 max(0, S(x, y) - z)^2 / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere");
  EXPECT_EQ(of(crossed, Mode::force_shaded), "none");
}

TEST(height_energy, bounds_equal_the_closed_forms) {
  const HeightMap waves{{{height::Grating{1, 1, 0, 0}}}}, cone{{{height::Cone{1, 2, 3, 4}}}},
      ridge{{{height::CylinderCap{0, 15.24F, 25.4F}}}}, slope{{{height::Plane{0.75F, 0, 0}}}};
  const auto bound = [](const HeightMap& map, Mode mode, const Slice& slice, float depth, float K = 1) {
    return loop_bound(build(map, mode, K), slice, depth);
  };
  // The rectangle under cos x from 0.5 to 1.5, all of which generates energy.
  const auto upright = [](double x) { return 1 / std::hypot(1, std::sin(x)); };
  const auto area = [](double x) { return std::asin(std::cos(x) / std::sqrt(2)); };
  const double D = static_cast<double>(0.1F);
  const SliceBound wave = bound(waves, Mode::force_shaded, {Along::x, 0, 0.5F, 1.5F}, 0.1F);
  expect_near(wave.counter_clockwise, D * (area(0.5) - area(1.5)) + D * D / 2 * (upright(1.5) - upright(0.5)), "cos x");
  EXPECT_NEAR(low(wave.counter_clockwise), 0.0610, 5e-5);
  EXPECT_EQ(low(wave.clockwise), 0);
  // From crest to steepest flank and back, four times each in four half waves.
  const Slice four{Along::x, 0, static_cast<float>(-2 * M_PI), static_cast<float>(2 * M_PI)};
  const SliceBound true_waves = bound(waves, Mode::true_height, four, 0.1F);
  expect_near(true_waves.counter_clockwise, 4 * D * D / 2 * (1 - std::sqrt(0.5)), "true waves");
  expect_near(true_waves.clockwise, 4 * D * D / 2 * (1 - std::sqrt(0.5)), "true waves");
  // Both rims and no more, wherever the slice meets the cone.
  const double rim = 0.5 * (1 - 1 / std::hypot(1, 0.75));
  for (const float y : {2.0F, 2.001F, 1.0F, -1.9F, 5.9F}) {
    const SliceBound rims = bound(cone, Mode::true_height, {Along::x, y, -10, 10}, 1);
    expect_near(rims.counter_clockwise, rim, "cone");
    expect_near(rims.clockwise, rim, "cone");
  }
  EXPECT_EQ(bound(cone, Mode::true_height, {Along::x, 6, -10, 10}, 1).most().high, 0) << "a rim touched";
  EXPECT_EQ(bound(cone, Mode::true_height, {Along::x, 2, 1, 4}, 1).most().high, 0) << "an end on the apex";
  // 1/n rises from rim to crest, and jumps on the rim.
  const double d = std::sqrt(15.24 * 15.24 - 12.7 * 12.7);
  const SliceBound true_ridge = bound(ridge, Mode::true_height, {Along::x, 3, -14, 14}, 2, 0.5F);
  expect_near(true_ridge.counter_clockwise, 2 * (1 - d / 15.24), "true ridge");
  expect_near(true_ridge.clockwise, 2 * (1 - d / 15.24), "true ridge");
  EXPECT_EQ(bound(ridge, Mode::true_height, {Along::y, 3, -14, 14}, 2).most().high, 0) << "along the ridge";
  // A sideways force K·depth·m/n, lost or won by the depth at which the hand goes there.
  const SliceBound plane = bound(slope, Mode::force_shaded, {Along::x, 0, -10, 10}, 2);
  EXPECT_EQ(low(plane.counter_clockwise), 0);
  expect_near(plane.clockwise, 2 * 20 * 0.6, "slope");
}

TEST(height_energy, a_ridge_shaded_is_the_law_bump_1p_shaded) {
  for (const Parameters& p : {Parameters{15.24F, 25.4F, 0.5F}, {35.56F, 25.4F, 2}, {10, 19.5F, 1}})
    for (const float depth : {0.5F, 2.0F, 9.0F, 12.0F, 40.0F}) {
      const LoopBound law = loop_bound(std::get<Law>(Law::build(LawId::bump_1p_shaded, p)), depth);
      const HeightMapField map = build({{{height::CylinderCap{0, p.radius, p.width}}}}, Mode::force_shaded, p.stiffness);
      const SliceBound right = loop_bound(map, {Along::x, 1, 0, 14}, depth),
                       all = loop_bound(map, {Along::x, 1, -14, 14}, depth);
      expect_near(right.counter_clockwise, low(law.counter_clockwise), low(law.anywhere), "right half");
      expect_near(right.clockwise, low(law.clockwise), low(law.anywhere), "right half");
      expect_near(all.counter_clockwise, low(law.anywhere), low(law.anywhere), "both halves");
      expect_near(all.clockwise, low(law.anywhere), low(law.anywhere), "both halves");
    }
}

TEST(height_energy, polygons_shaded_by_a_ridge_are_the_law_bump_2p_shaded) {
  // R = 1.25, w = 1.5: the bump's height is 1/4.
  const HeightMap map{{{height::CylinderCap{0, 1.25F, 1.5F}}}, {{height::Polygons{{{-0.75F, 0}, {0, 0.25F}, {0.75F, 0}}}}}};
  for (const float depth : {0.1F, 0.5F, 2.0F}) {
    const LoopBound law = loop_bound(std::get<Law>(Law::build(LawId::bump_2p_shaded, {1.25F, 1.5F, 1})), depth);
    const SliceBound bound = loop_bound(build(map, Mode::force_shaded), {Along::x, 0, -2, 2}, depth);
    expect_near(bound.counter_clockwise, low(law.anywhere), "counter-clockwise");
    expect_near(bound.clockwise, low(law.anywhere), "clockwise");
  }
}

TEST(height_energy, of_a_loop_is_the_difference_of_what_pays_and_what_costs_inside) {
  // Around all of a slice and all of the depth: both bounds' difference.
  for (const HeightExample& example : height_examples()) {
    const HeightMapField law = build(example.map, Mode::force_shaded);
    const Path around{{-7, 1.3F, -0.5F}, {6, 1.3F, -0.5F}, {6, 1.3F, 0}, {-7, 1.3F, 0}, {-7, 1.3F, -0.5F}};
    const SliceBound bound = loop_bound(law, {Along::x, 1.3F, -7, 6}, 0.5F);
    const double most = low(bound.most());
    EXPECT_NEAR(low(work(law, around)), low(bound.counter_clockwise) - low(bound.clockwise), 1e-7 * most) << example.name;
  }
}

TEST(height_energy, depths_and_slices_outside_the_domain_are_refused) {
  const auto words = [](const HeightMap& map, Mode mode, const Slice& slice, float depth) {
    const auto error = slice_error(build(map, mode), slice, depth);
    return error ? error->message() : "fine";
  };
  const HeightMap hill{{{height::Gaussian{0, 0, 20, 2}}}}, plateau{{{height::Plane{0, 0, 6000}}}};
  constexpr auto kTrue = Mode::true_height;
  EXPECT_EQ(words(hill, kTrue, {}, 2), "fine");
  EXPECT_EQ(words(hill, kTrue, {}, 0.002F), "fine");
  EXPECT_EQ(words(hill, kTrue, {}, 0.001F), "depth is 0.001 mm; expected 0.002 to 4990 mm");
  EXPECT_EQ(words(hill, Mode::force_shaded, {}, 0.0013F), "fine");
  EXPECT_EQ(words(hill, kTrue, {}, 4991), "depth is 4991 mm; expected 0.002 to 4990 mm");
  EXPECT_EQ(words(hill, kTrue, {}, std::nanf("")), "depth is nan mm; expected 0.002 to 4990 mm");
  EXPECT_EQ(words(hill, kTrue, {Along::x, 10001, -1, 1}, 2), "at is 10001 mm; expected -10000 to 10000 mm");
  EXPECT_NE(words(hill, kTrue, {Along::x, 0, 1, 1}, 2).find("to is 1 mm; expected 1"), std::string::npos);
  EXPECT_NE(words(hill, kTrue, {Along::x, 0, 10000, 10000}, 2).find("from is 10000 mm"), std::string::npos);
  EXPECT_EQ(words(plateau, kTrue, {}, 2), "largest height is 6000 mm; expected 0 to 5000 mm");
  EXPECT_EQ(words(plateau, Mode::force_shaded, {}, 2), "fine");
  const auto fine = std::make_shared<height::Grid>(
      height::Grid{2, 2, 0.001F, height::Edge::tile, height::Interpolant::cubic_spline, {1, 2, 3, 4}});
  EXPECT_EQ(words({{{fine}}}, kTrue, {Along::x, 0, -10, 10}, 2), "fine");
  EXPECT_NE(words({{{fine}}}, kTrue, {Along::x, 0, -50, 50}, 2).find("number of cells is"), std::string::npos);
}

}  // namespace
}  // namespace forceshade::reference
