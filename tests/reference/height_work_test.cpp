// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "reference/height_energy.h"
#include "reference/numbers/taylor_coefficients.h"
#include "tests/height_maps/height_examples.h"
#include "tests/support/drawn.h"

namespace forceshade::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using height::Mode;
using Path = std::vector<Vector3f>;

constexpr float kStiffness = 0.5F;

HeightMapField build(const HeightMap& map, Mode mode) {
  return std::get<HeightMapField>(HeightMapField::build(map, mode, kStiffness));
}

double low(const Interval& value) {
  return value.low.convert_to<double>();
}

double width(const Interval& value) {
  return Multiprecision(value.high - value.low).convert_to<double>();
}

Path random_path(std::mt19937& random) {
  const auto uniform = [&](float from, float to) { return std::uniform_real_distribution<float>(from, to)(random); };
  Path path;
  for (int i = 0; i < 4; ++i) path.push_back({uniform(-7, 7), uniform(-7, 7), uniform(-1.5F, 1)});
  return path;
}

TEST(height_work, equals_the_force_summed_along_the_path) {
  std::mt19937 random(1);
  constexpr int kSteps = 1000;
  double worst = 0;
  for (const HeightExample& example : height_examples())
    for (const auto& [mode, name] : height::kModes) {
      const HeightMapField law = build(example.map, mode);
      for (std::size_t i = 0; i < tests::drawn(3); ++i) {
        const Path path = random_path(random);
        const Interval exact = work(law, path);
        double generated = 0, length = 0;
        for (std::size_t k = 1; k < path.size(); ++k) {
          const Vector3d from = path[k - 1].cast<double>(), way = path[k].cast<double>() - from;
          length += way.norm();
          for (int step = 0; step < kSteps; ++step) {
            const Vector3f at = (from + (step + 0.5) / kSteps * way).cast<float>();
            generated += law.round_to_binary32(at).force.cast<double>().dot(way) / kSteps;
          }
        }
        // A step may straddle a kink: some ten of them, where the force turns by 0.6 N or so, half a step each.
        const double tolerance = 10 * 0.6 * length / 3 / kSteps / 2;
        EXPECT_GE(width(exact), 0);
        EXPECT_LT(width(exact), 1e-8) << example.name;
        EXPECT_NEAR(low(exact), generated, tolerance) << example.name << ' ' << name;
        worst = std::max(worst, std::fabs(low(exact) - generated) / tolerance);
      }
    }
  std::printf("  worst difference %.2f of what the steps allow\n", worst);
  EXPECT_GT(worst, 0.1) << "a tolerance that loose finds nothing";
}

TEST(height_work, around_a_closed_path_is_nothing_for_the_conservative_rendering) {
  std::mt19937 random(2);
  for (const HeightExample& example : height_examples()) {
    Path path = random_path(random);
    path.push_back(path.front());
    const Interval around = work(build(example.map, Mode::conservative), path);
    EXPECT_LE(around.low, 0) << example.name;
    EXPECT_GE(around.high, 0) << example.name;
    EXPECT_LT(width(around), 1e-60) << example.name;
  }
}

TEST(height_work, of_true_heights_is_the_potentials_difference_where_there_is_one) {
  const HeightMapField law = build({{{height::Plane{0.75F, 1, 0}}}}, Mode::true_height);
  const double n = std::sqrt(1 + 0.5625 + 1);
  EXPECT_NEAR(low(work(law, {{0, 0, 1}, {1, 2, 0.75F}})), -0.25 / n * 4, 1e-12) << "from outside to 2 mm below 2.75 mm";
}

TEST(height_work, does_not_depend_on_where_a_straight_path_is_cut) {
  for (const HeightExample& example : height_examples())
    for (const auto& [mode, name] : height::kModes) {
      const HeightMapField law = build(example.map, mode);
      const Path whole{{-6, -2, -0.5F}, {6, 4, 0.25F}}, cut{{-6, -2, -0.5F}, {-2, 0, -0.25F}, {2, 2, 0}, {6, 4, 0.25F}};
      const Interval a = work(law, whole), b = work(law, cut);
      EXPECT_NEAR(low(a), low(b), 1e-9) << example.name << ' ' << name;
      EXPECT_GT(std::fabs(low(a)), 1e-3) << example.name << ' ' << name;
    }
}

TEST(height_work, there_and_back_is_nothing) {
  // The ends lie on cell lines, knots, rims and the apex.
  for (const HeightExample& example : height_examples())
    for (const auto& [mode, name] : height::kModes)
      for (const auto& [from, to] : {std::pair{Vector3f(0.375F, 2, -0.5F), Vector3f(-5, 2, -0.25F)},
                                     {{3, 1.125F, -0.5F}, {-1, -1.125F, 0.25F}},
                                     {{5, -0.5F, -0.5F}, {-3, -0.5F, -0.5F}}}) {
        const Interval generated = work(build(example.map, mode), {from, to, from});
        EXPECT_LT(std::fabs(low(generated)), 1e-9) << example.name << ' ' << name;
      }
}

TEST(height_work, straight_up_on_a_kink_is_that_of_the_side_with_larger_x) {
  const auto share = [](const HeightMap& map, float x, float y) {
    return low(work(build(map, Mode::force_shaded), {{x, y, -1}, {x, y, 0}})) / (0.5 * static_cast<double>(kStiffness));
  };
  const HeightMap ridge{{{height::CylinderCap{0, 5, 8}}}}, cone{{{height::Cone{0, 0, 3, 4}}}};
  EXPECT_NEAR(share(ridge, -4, 0), 0.6, 1e-12);
  EXPECT_NEAR(share(ridge, 4, 0), 1, 1e-12);
  EXPECT_NEAR(share(cone, -4, 0), 0.8, 1e-12);
  EXPECT_NEAR(share(cone, 4, 0), 1, 1e-12);
  EXPECT_NEAR(share(cone, 0, 0), 0.8, 1e-12);
}

TEST(height_work, along_a_kink_is_that_of_the_side_with_larger_x_then_y) {
  // Two slopes that meet on x = 0 and, turned, on y = 0: flat where the coordinate is less, then rising by 3 in 4.
  const auto fold = [](bool is_turned) {
    const std::vector<float> values = is_turned ? std::vector<float>{0, 0, 0, 0, 0, 0, 0.75F, 0.75F, 0.75F}
                                                : std::vector<float>{0, 0, 0.75F, 0, 0, 0.75F, 0, 0, 0.75F};
    return HeightMap{
        {{std::make_shared<height::Grid>(height::Grid{3, 3, 1, height::Edge::clamp, height::Interpolant::bilinear, values})}}};
  };
  // At a depth of 1, down by 1/4 along it: K·∫depth/n.
  const double generated = -static_cast<double>(kStiffness) * (0.25 + 0.03125) * 0.8;
  EXPECT_NEAR(low(work(build(fold(false), Mode::force_shaded), {{0, -0.5F, -1}, {0, 0.5F, -1.25F}})), generated, 1e-12);
  EXPECT_NEAR(low(work(build(fold(true), Mode::force_shaded), {{-0.5F, 0, -1}, {0.5F, 0, -1.25F}})), generated, 1e-12);
}

TEST(series, holds_the_taylor_coefficients_of_what_was_computed) {
  using S = Series<6>;
  const double at = 0.7;
  const S x = S::variable(at, 1.0);
  const auto expect = [&](const char* what, const S& found, auto&& coefficient) {
    for (std::size_t k = 0; k <= 6; ++k) {
      const double exact = coefficient(static_cast<int>(k));
      EXPECT_NEAR(static_cast<double>(found[k].mid()), exact, 1e-14 * std::max(1.0, std::fabs(exact))) << what << ' ' << k;
      EXPECT_LT(found[k].rad(), 1e-15L) << what << ' ' << k;
      EXPECT_GT(found[k].rad(), 0) << what << ' ' << k;
    }
  };
  const auto factorial = [](int k) { return std::tgamma(k + 1.0); };
  expect("e^x", exp(x), [&](int k) { return std::exp(at) / factorial(k); });
  expect("sin x", sine_and_cosine(x)[0], [&](int k) { return std::sin(at + k * M_PI / 2) / factorial(k); });
  expect("cos x", sine_and_cosine(x)[1], [&](int k) { return std::cos(at + k * M_PI / 2) / factorial(k); });
  expect("1/(1 + x)", S(1.0) / (S(1.0) + x), [&](int k) { return std::pow(-1, k) / std::pow(1 + at, k + 1); });
  expect("√(1 + x)", sqrt(S(1.0) + x), [&](int k) {
    double binomial = 1;
    for (int i = 0; i < k; ++i) binomial *= (0.5 - i) / (i + 1);
    return binomial * std::pow(1 + at, 0.5 - k);
  });
}

}  // namespace
}  // namespace forceshade::reference
