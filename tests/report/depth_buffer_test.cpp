// SPDX-License-Identifier: BSD-3-Clause
#include "report/depth_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace forceshade::properties {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

constexpr SampleGrid kGrid{-10, -5, 0.1, 200, 100};

// A triangle across the whole rectangle, at z = height + slope x.
Corners large(double height, double slope = 0) {
  const auto corner = [&](double x, double y) { return Eigen::Vector3d(x, y, height + slope * x); };
  return {corner(-100, -100), corner(100, -100), corner(0, 200)};
}

Corners turned_over(const Corners& corners) {
  return {corners[0], corners[2], corners[1]};
}

TEST(view_direction, turns_the_viewer_about_z_and_lifts_it) {
  const auto is_near = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() < 1e-15; };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(is_near(ViewDirection(0, 0).turned(x), x));
  EXPECT_TRUE(is_near(ViewDirection(0, 0).turned(z), y));
  EXPECT_TRUE(is_near(ViewDirection(0, 0).turned(-y), z));
  EXPECT_TRUE(is_near(ViewDirection(90, 0).turned(x), z)) << "the viewer stands on the positive x axis";
  EXPECT_TRUE(is_near(ViewDirection(90, 0).turned(y), x));
  EXPECT_TRUE(is_near(ViewDirection(0, 90).turned(z), z)) << "the viewer looks down";
  EXPECT_TRUE(is_near(ViewDirection(0, 90).turned(y), y));
}

TEST(depth_buffer, keeps_the_triangle_in_front_in_whatever_order_they_come) {
  for (const bool front_first : {true, false}) {
    DepthBuffer buffer(kGrid);
    const Corners front = turned_over(large(1)), back = large(-1);
    buffer.draw(front_first ? front : back);
    buffer.draw(front_first ? back : front);
    EXPECT_LT(buffer.shade(100, 50), 0) << "it shows its back";
    EXPECT_FALSE(buffer.hides({0.05, 0.05, 1}));
    EXPECT_TRUE(buffer.hides({0.05, 0.05, 0.8}));
  }
}

// No order of two triangles that overlap as these three do could be drawn one after the other.
TEST(depth_buffer, draws_triangles_that_overlap_in_a_circle) {
  DepthBuffer buffer(kGrid);
  const auto bar = [](double angle) {
    const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0), across(-along.y(), along.x(), 0), up(0, 0, 1);
    return Corners{across * 2 - along * 4 - up, across * 2 + along * 4 + up, across * 2.6 + along * 4 + up};
  };
  for (const double turn : {0.0, 2.0943951023931953, 4.1887902047863905}) buffer.draw(bar(turn));
  int hidden = 0;
  for (const double turn : {0.0, 2.0943951023931953, 4.1887902047863905}) {
    const Corners corners = bar(turn);
    const Eigen::Vector3d middle = (corners[1] + corners[2]) / 2;
    for (int i = 0; i < 100; ++i) hidden += buffer.hides(corners[0] + i / 100.0 * (middle - corners[0])) ? 1 : 0;
    EXPECT_FALSE(buffer.hides(corners[0] + 0.9 * (middle - corners[0]))) << "the upper end of each is in front";
  }
  EXPECT_GT(hidden, 0);
}

TEST(depth_buffer, hides_no_point_of_a_slope_in_front) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-9.5, 9.5), y(-4.5, 4.5);
  for (const double slope : {0.0, 0.5, 3.0, -20.0}) {
    DepthBuffer buffer(kGrid);
    buffer.draw(large(0, slope));
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d point(x(random), y(random), 0), on_slope = point + Eigen::Vector3d(0, 0, slope * point.x());
      EXPECT_FALSE(buffer.hides(on_slope)) << slope;
      EXPECT_TRUE(buffer.hides(on_slope - Eigen::Vector3d(0, 0, 0.3 + 0.2 * std::fabs(slope)))) << slope;
    }
  }
}

TEST(depth_buffer, draws_nothing_beside_a_triangle_and_lines_along_its_sides) {
  DepthBuffer buffer(kGrid);
  buffer.draw({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(0, 4, 0)});
  buffer.draw({Eigen::Vector3d(100, 0, 0), Eigen::Vector3d(104, 0, 0), Eigen::Vector3d(100, 4, 0)});
  buffer.draw({Eigen::Vector3d(-4, 0, 0), Eigen::Vector3d(-4, 1, 3), Eigen::Vector3d(-4, 2, 0)});
  EXPECT_EQ(buffer.shade(99, 60), 1) << "left of it";
  EXPECT_EQ(buffer.shade(60, 60), 1) << "a triangle seen from the side";
  EXPECT_FALSE(buffer.hides({-1, -1, -50}));
  EXPECT_FALSE(buffer.hides({50, 0, -50})) << "outside of the picture";
  const float inside = buffer.shade(110, 60);
  EXPECT_GT(inside, 0);
  EXPECT_LT(inside, 1);
  EXPECT_LT(buffer.shade(110, 50), inside) << "the line along its side";
  int drawn = 0;
  for (int row = 0; row < kGrid.rows; ++row)
    for (int column = 0; column < kGrid.columns; ++column) drawn += buffer.shade(column, row) < 1 ? 1 : 0;
  EXPECT_NEAR(drawn, 800, 40) << "half of 40 x 40 samples, and those on the side";
}

}  // namespace
}  // namespace forceshade::properties
