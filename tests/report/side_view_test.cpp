// SPDX-License-Identifier: BSD-3-Clause
// The side view shows a height map as it is.

#include "report/side_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace forceshade::properties {
namespace {

using height::Mode;

SideView view_of(const HeightMap& map, Mode mode, const Range& range) {
  return side_view(std::get<RenderedHeightMap>(fast_rendering(map, mode, 0.5F)), "map", range);
}

TEST(side_view, shows_the_surface_that_a_force_begins_on_and_the_one_it_is_felt_as) {
  const HeightMap hill{{{height::Gaussian{0, 0, 3, 5}}}};
  const double there = 3 * std::exp(-0.5 * (16 + 4) / 25);
  const SideView seen = view_of(hill, Mode::true_height, {2, -8, 8}), shaded = view_of(hill, Mode::force_shaded, {2, -8, 8});
  EXPECT_NEAR(seen.surface(4), there, 1e-12);
  EXPECT_TRUE(std::isnan(seen.stands_for(4)));
  EXPECT_EQ(shaded.surface(4), 0);
  EXPECT_NEAR(shaded.stands_for(4), there, 1e-12);
  for (const SideView* view : {&seen, &shaded}) {
    EXPECT_LT(view->shown.low, view->surface(0) - view->depths[2]);
    EXPECT_GT(view->shown.high, 3 * std::exp(-0.08));
    EXPECT_TRUE(view->jumps.empty());
    EXPECT_GT(view->force(4, -1).x(), 0);
  }
}

TEST(side_view, is_no_taller_than_wide) {
  const SideView view = view_of({{{height::Plane{1e3F, 0, 0}}}}, Mode::true_height, {0, -1, 1});
  EXPECT_LE(view.shown.high - view.shown.low, 2 * (1 + 1e-9));
}

TEST(side_view, finds_the_lines_on_which_the_force_jumps) {
  const auto near = [](const std::vector<double>& got, const std::vector<double>& wanted) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 1e-5);
  };
  near(view_of({{{height::CylinderCap{0, 8, 10}, true}}}, Mode::conservative, {0, -8, 8}).jumps, {-5, 5});
  near(view_of({{{height::Cone{1, 0, 2, 5}}}}, Mode::true_height, {3, -8, 8}).jumps, {-3, 5});
  near(view_of({{{height::Cone{1, 0, 2, 5}}}}, Mode::true_height, {0, -8, 8}).jumps, {-4, 1, 6});
  // Lines at the steps of the picture themselves, and one across which nothing bends.
  const auto roof = std::make_shared<const height::Grid>(
      height::Grid{5, 2, 1, height::Edge::clamp, height::Interpolant::bilinear, {0, 0, 1, 2, 2, 0, 0, 1, 2, 2}});
  const SideView view = view_of({{{roof}}}, Mode::true_height, {0, -3, 3});
  near(view.jumps, {-1, 1});
  int broken = 0;
  for (const Sample& sample : view.across) broken += sample.after_jump;
  EXPECT_EQ(broken, 2);
}

// κ = -M(U_x U_xx + U_y U_xy)/n³ for a true height; of a field with a potential nothing.
TEST(side_view, maps_the_energy_that_small_loops_generate) {
  const HeightMap hill{{{height::Gaussian{0, 0, 3, 5}}}};
  const double x = 4, y = 2, z = -1, U = 3 * std::exp(-0.5 * (x * x + y * y) / 25), ux = -x / 25 * U, uy = -y / 25 * U;
  const double uxx = (x * x / 25 - 1) / 25 * U, uxy = x * y / 625 * U;
  const double kappa = -0.5 * (U - z) * (ux * uxx + uy * uxy) / std::pow(1 + ux * ux + uy * uy, 1.5);
  EXPECT_NEAR(view_of(hill, Mode::true_height, {2, -8, 8}).density(x, z), kappa, 1e-6);
  EXPECT_GT(std::fabs(kappa), 1e-3);
  EXPECT_EQ(view_of(hill, Mode::conservative, {2, -8, 8}).density(x, z), 0);
}

}  // namespace
}  // namespace forceshade::properties
