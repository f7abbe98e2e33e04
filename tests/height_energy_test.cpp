// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/height_energy.h"

#include <gtest/gtest.h>

namespace forceshade::reference {
namespace {

using height::Rendering;

HeightLaw build(HeightMap map, Rendering rendering, float stiffness = 1) {
  return std::get<HeightLaw>(HeightLaw::build(std::move(map), rendering, stiffness));
}

TEST(height_energy, only_planes_and_the_gradient_have_a_potential) {
  const auto of = [](const HeightMap& map, Rendering rendering) { return potential(build(map, rendering)).value_or("none"); };
  const HeightMap hill{{{height::Gaussian{0, 0, 1, 2}}}}, slope{{{height::Plane{0.5F, 0, 1}}}},
      level{{{height::Plane{0.5F, -1, 1}}, {height::Plane{0.5F, -1, 0}, true}, {height::Grating{1, 0, 0, 1}}}},
      plate{{{std::make_shared<height::Grid>(
          height::Grid{2, 2, 1, height::Edge::clamp, height::Interpolant::cubic_spline, {3, 3, 3, 3}})}}},
      step{{{std::make_shared<height::Grid>(
          height::Grid{2, 2, 1, height::Edge::clamp, height::Interpolant::cubic_spline, {3, 3, 3, 4}})}}};
  for (const HeightMap& map : {hill, slope, level, plate, step})
    EXPECT_EQ(of(map, Rendering::conservative), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of(hill, Rendering::true_height), "none");
  EXPECT_EQ(of(step, Rendering::true_height), "none");
  EXPECT_EQ(of(slope, Rendering::true_height),
            "K/2 max(0, U(x, y) - z)^2 / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere");
  EXPECT_EQ(of(level, Rendering::true_height), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of(hill, Rendering::force_shaded), "none");
  EXPECT_EQ(of(slope, Rendering::force_shaded), "none") << "sideways force that grows with the depth below the flat plane";
  EXPECT_EQ(of(level, Rendering::force_shaded), "K/2 max(0, -z)^2");
  EXPECT_EQ(of(plate, Rendering::force_shaded), "K/2 max(0, -z)^2");

  const height::Polygons ridge{{{-1, 0}, {0, 1}, {1, 0}}}, shelf{{{-1, 2}, {1, 2}}};
  EXPECT_EQ(of({{{ridge}}}, Rendering::true_height), "none");
  EXPECT_EQ(of({{{shelf}}}, Rendering::true_height), "K/2 max(0, U(x, y) - z)^2");
  EXPECT_EQ(of({{{shelf}}, {{ridge}}}, Rendering::force_shaded), "none") << "a normal that stays, a depth that does not";
  EXPECT_EQ(of({{{shelf}}, {{shelf}}}, Rendering::force_shaded), "K/2 max(0, S(x, y) - z)^2");
  EXPECT_EQ(of({slope.parts, slope.parts}, Rendering::force_shaded),
            "K/2 max(0, S(x, y) - z)^2 / n, where n = sqrt(1 + U_x^2 + U_y^2) is the same everywhere");
}

}  // namespace
}  // namespace forceshade::reference
