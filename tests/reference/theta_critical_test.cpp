// SPDX-License-Identifier: BSD-3-Clause
#include "reference/theta_critical.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace forceshade::reference {
namespace {

// The angles of figure 5-5 of the thesis, from an independent arcsine: 2 arcsin(500/R) for R in mil. 1000 mil is 25.4 mm, and a
// quarter more in binary32 than R = 600 mil to seven digits.
TEST(theta_critical, subtended_angles_are_those_of_the_thesis) {
  for (const int mil : {600, 800, 1000, 1200, 1400}) {
    const Parameters bump{static_cast<float>(mil * 0.0254), 25.4F, 1};
    for (const unsigned polygons : {1U, 2U, 3U}) {
      const double degrees = std::stod(subtended_degrees(bump, polygons, 7));
      EXPECT_NEAR(degrees, 360 / std::numbers::pi * std::asin(500.0 / mil) / polygons, 3e-5);
    }
  }
}

TEST(theta_critical, rational_angles_are_exact) {
  EXPECT_EQ(subtended_degrees({12.7F, 25.4F, 1}, 1, 30), "180.000000000000000000000000000");
  EXPECT_EQ(subtended_degrees({5, 5, 1}, 1, 3), "60.0");
  EXPECT_EQ(subtended_degrees({5, 5, 1}, 16, 2), "3.8");  // 3.75: to even
  EXPECT_EQ(subtended_degrees({5, 5, 1}, 48, 2), "1.2");  // 1.25: to even
}

// Each must subtend less, not as much: 60 degrees in two parts are 30 each.
TEST(theta_critical, equality_needs_one_more_polygon) {
  const Parameters sixty{5, 5, 1}, half_round{12.7F, 25.4F, 1};
  EXPECT_EQ(polygons_needed(sixty, 60), 2U);
  EXPECT_EQ(polygons_needed(sixty, std::nextafter(60, 61)), 1U);
  EXPECT_EQ(polygons_needed(sixty, 30), 3U);
  EXPECT_EQ(polygons_needed(sixty, std::nextafter(30, 29)), 3U);
  EXPECT_EQ(polygons_needed(sixty, std::nextafter(30, 31)), 2U);
  EXPECT_EQ(polygons_needed(half_round, 180), 2U);
  EXPECT_EQ(polygons_needed(half_round, 60), 4U);
  EXPECT_EQ(polygons_needed(half_round, kLeastThetaCritical), 180'000'001U);  // 1e-6 in binary64 is a little less
}

// 0.1 in binary64 is a little more, 0.3 a little less.
TEST(theta_critical, is_the_number_that_was_typed) {
  const Parameters sixty{5, 5, 1}, half_round{12.7F, 25.4F, 1};
  for (unsigned tenths = 1; tenths <= 1800; ++tenths) {
    const RationalAngle typed(std::to_string(tenths) + "/10", false);
    EXPECT_EQ(polygons_needed(sixty, typed), 600 / tenths + 1) << tenths;
    EXPECT_EQ(polygons_needed(half_round, typed), 1800 / tenths + 1) << tenths;
  }
  EXPECT_EQ(polygons_needed(half_round, {"1/1000000", false}), 180'000'001U);
  // 60 degrees are 1.0471975511965977461... rad.
  EXPECT_EQ(polygons_needed(sixty, {"10471975511965977461/10000000000000000000", true}), 2U);
  EXPECT_EQ(polygons_needed(sixty, {"10471975511965977462/10000000000000000000", true}), 1U);
}

TEST(theta_critical, fewest_polygons_are_enough_and_one_less_is_not) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.001F, 1);
  for (int i = 0; i < 300; ++i) {
    const float radius = std::exp2(10 * share(random));
    const Parameters bump{radius, 2 * radius * share(random), 1};
    const double theta_critical = 60 * static_cast<double>(share(random));
    const unsigned polygons = polygons_needed(bump, theta_critical);
    EXPECT_LT(std::stod(subtended_degrees(bump, polygons, 17)), theta_critical * (1 + 1e-14));
    if (polygons == 1) continue;
    EXPECT_GT(std::stod(subtended_degrees(bump, polygons - 1, 17)), theta_critical * (1 - 1e-14));
  }
}

}  // namespace
}  // namespace forceshade::reference
