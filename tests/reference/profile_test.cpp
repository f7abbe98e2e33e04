// SPDX-License-Identifier: BSD-3-Clause
// Polygons under any profile: how far its normal turns, how many polygons that requires, and where their ends are.

#include "reference/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "reference/theta_critical.h"
#include "tests/support/words.h"

namespace forceshade::reference {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

void expect_turning(const Profile& profile, double degrees, double slack = 1e-12) {
  EXPECT_LE(profile.least_turning(), profile.most_turning());
  EXPECT_LT(profile.most_turning() - profile.least_turning(), 1e-12);
  EXPECT_NEAR(profile.least_turning(), degrees, slack);
}

TEST(profile, turns_as_far_as_worked_out_by_hand) {
  expect_turning(Profile({{height::Plane{3, 1, 2}}}, -5, 5), 0);
  expect_turning(Profile({{height::SphereCap{1, 0, 5, 8}}}, -2, 4), kDegrees * 2 * std::asin(0.6));
  expect_turning(Profile({{height::SphereCap{0, 4, 5, 10 - 1e-3F}, true}}, -2.5F, 2.5F), kDegrees * 2 * std::asin(2.5 / 3));
  // A wave: from slope 0 up to its steepest, down and back, twice per period.
  const height::Grating wave{0.5F, 2, 7, 0};
  const auto period = static_cast<float>(std::numbers::pi);  // 2e-7 short, where a grating is level
  expect_turning(Profile({{wave}}, 0, 3 * period), 3 * 4 * kDegrees * std::atan(1.0), 1e-4);
  // A hill: level, steepest at -sigma, level on top, and down again; from far to far.
  const double steepest = std::atan(2 / 1.5 * std::exp(-0.5));
  expect_turning(Profile({{height::Gaussian{1, 0, 2, 1.5F}}}, -29, 31), kDegrees * 4 * steepest);
  // Beside its apex a cone's section is a hyperbola.
  const double ratio = 2.0 / 3 * 3 / std::sqrt(9 + 1);
  expect_turning(Profile({{height::Cone{0, 1, 4, 6}}}, -3, 3), kDegrees * 2 * std::atan(ratio));
  expect_turning(Profile({{height::Cone{0, 0, 4, 6}}}, 0, 6), 0);
}

TEST(profile, of_a_spline_turns_as_its_cells_do) {
  // Coefficients i² in x alone: U_x = 2i/p·... a parabola of slope 2x/p² with p = 2, but where the edge holds the ends.
  std::vector<float> values;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 9; ++i) values.push_back(static_cast<float>((i - 4) * (i - 4)));
  const auto grid = std::make_shared<const height::Grid>(
      height::Grid{9, 4, 2, height::Edge::clamp, height::Interpolant::cubic_spline, values});
  expect_turning(Profile({{grid}}, -4, 5), kDegrees * (std::atan(2.0) + std::atan(2.5)));
  // Beyond the edge it levels out: all that was turned on the way up is turned again.
  const Profile whole({{grid}}, -30, 30);
  EXPECT_GT(whole.least_turning(), kDegrees * 4 * std::atan(3.0));
}

TEST(profile, needs_as_many_polygons_as_the_bumps_of_the_thesis) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.001F, 0.999F);
  for (int i = 0; i < 200; ++i) {
    const float radius = std::exp2(10 * share(random)), width = 2 * radius * share(random);
    const double theta_critical = 60 * static_cast<double>(share(random));
    const Profile profile({{height::CylinderCap{0, radius, width}}}, -width / 2, width / 2);
    const auto needed = profile.polygons_needed(theta_critical);
    EXPECT_EQ(needed.polygons, polygons_needed({radius, width, 1}, theta_critical)) << radius << ' ' << width;
    EXPECT_TRUE(needed.is_fewest);
  }
}

TEST(profile, equality_needs_one_more_polygon) {
  const Profile sixty({{height::CylinderCap{0, 5, 5}}}, -2.5F, 2.5F);
  EXPECT_EQ(sixty.polygons_needed(60).polygons, 2U);
  EXPECT_FALSE(sixty.polygons_needed(60).is_fewest) << "enclosures do not decide it";
  EXPECT_EQ(sixty.polygons_needed(std::nextafter(60, 61)).polygons, 1U);
  EXPECT_EQ(sixty.polygons_needed(30).polygons, 3U);
}

// On a cylinder the ends lie at equal angles; on any profile each piece turns as far as the others.
TEST(profile, its_polygons_turn_equally) {
  const Profile cap({{height::CylinderCap{0, 15.24F, 25.4F}}}, -12.7F, 12.7F);
  const auto knots = cap.knots(3);
  ASSERT_EQ(knots.size(), 4U);
  const double half = std::asin(12.7 / 15.24);
  EXPECT_EQ(knots[0].x, -12.7F);
  EXPECT_EQ(knots[0].height, 0);
  EXPECT_NEAR(static_cast<double>(knots[1].x), -15.24 * std::sin(half / 3), 1e-6);
  EXPECT_NEAR(static_cast<double>(knots[1].height), 15.24 * (std::cos(half / 3) - std::cos(half)), 1e-6);
  EXPECT_NEAR(static_cast<double>(knots[2].x), 15.24 * std::sin(half / 3), 1e-6);
  EXPECT_EQ(knots[3].x, 12.7F);

  const std::vector<height::Part> hills{{height::Gaussian{1, 0.5F, 2, 1.5F}}, {height::Grating{0.25F, 3, 0, 1}}};
  const Profile profile(hills, -6, 7);
  for (const unsigned polygons : {1U, 2U, 7U, 100U}) {
    const auto ends = profile.knots(polygons);
    ASSERT_EQ(ends.size(), polygons + 1);
    for (unsigned i = 0; i < polygons; ++i) {
      const Profile piece(hills, ends[i].x, ends[i + 1].x);
      EXPECT_NEAR(piece.most_turning(), profile.most_turning() / polygons, 1e-3);
    }
  }
}

TEST(profile, refuses_kinks_and_says_which) {
  const auto words = [](height::Shape shape, float from, float to) -> std::string {
    return tests::thrown_by<std::invalid_argument>([&] { const Profile profile({{std::move(shape)}}, from, to); });
  };
  const std::string kink = "the section has a kink between its ends: ";
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, -3, 5), "");
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, 5, 9), "");
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, std::nextafter(-3.0F, -4.0F), 5), kink + "the rim of a cap or cone");
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, -4, 6), kink + "the rim of a cap or cone");
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, 2, 6), kink + "the rim of a cap or cone");
  EXPECT_EQ(words(height::CylinderCap{1, 5, 8}, -4, 0), kink + "the rim of a cap or cone");
  EXPECT_EQ(words(height::SphereCap{0, 4, 5, 8}, -4, 6), "") << "it touches the disk in a point";
  EXPECT_EQ(words(height::Cone{0, 0, 2, 3}, -1, 1), kink + "the apex of a cone");
  EXPECT_EQ(words(height::Polygons{{{0, 0}, {1, 1}, {2, 0}}}, 0.5F, 1.5F), kink + "a knot of polygons");
  EXPECT_EQ(words(height::Polygons{{{0, 0}, {1, 1}, {2, 0}}}, 0, 1), "");
  EXPECT_EQ(words(std::make_shared<const height::Grid>(
                      height::Grid{2, 2, 1, height::Edge::clamp, height::Interpolant::bilinear, {0, 1, 0, 1}}),
                  0, 1),
            kink + "grid lines of a bilinear map");
  EXPECT_EQ(words(height::Plane{}, 1, 1), "the section's ends are not one beyond the other, within 10000 mm");
  EXPECT_NE(words(height::Plane{}, 1, 10001), "");
  EXPECT_THROW(Profile({{height::Plane{}}}, 1, 2).knots(20'001), std::invalid_argument);
  EXPECT_EQ(words(height::Grating{1, 1000, 0, 0}, -5000, 5000), "the section turns to and fro too often");
}

}  // namespace
}  // namespace forceshade::reference
