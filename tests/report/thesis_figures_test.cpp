// SPDX-License-Identifier: BSD-3-Clause
// The thesis's figures have the numbers of their geometry, and panels that belong together are of one size.

#include "report/thesis_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "report/pictures.h"
#include "tests/support/has.h"

namespace forceshade::properties {
namespace {

using tests::has;

using Rows = std::vector<std::vector<double>>;

Rows rows_of(const std::string& csv, const std::string& header) {
  Rows rows;
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, header);
  while (std::getline(in, line)) {
    std::vector<double>& row = rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
  }
  return rows;
}

// The numbers of the thesis's figures by the geometry of circles: R the radius, 12.7 mm half of the width.
TEST(thesis_figures, have_the_numbers_of_their_geometry) {
  const std::vector<ThesisFigure> all = thesis_figures();
  std::string names;
  for (const ThesisFigure& figure : all) names += figure.name + ' ' + figure.picture.frame.id + ' ';
  EXPECT_EQ(names,
            "figure-2-3 figure-2-3 figure-4-2 figure-4-2 figure-5-1 figure-5-1 figure-5-4 figure-5-4 figure-5-5 figure-5-5 ");
  Rows rows = rows_of(all[0].csv, "x_mm,y_mm,u_mm");
  ASSERT_EQ(rows.size(), 41U * 41);
  EXPECT_EQ(rows.front()[0], -10);
  EXPECT_EQ(rows.front()[1], -10);
  EXPECT_EQ(rows[1][0], -9.5);
  EXPECT_EQ(rows.back()[1], 10);
  for (const auto& row : rows) {
    const auto hill = [&](double x, double y, double height, double sigma) {
      return height * std::exp(-((row[0] - x) * (row[0] - x) + (row[1] - y) * (row[1] - y)) / (2 * sigma * sigma));
    };
    EXPECT_NEAR(row[2], hill(-3, -3, 4, 3) - hill(4, 3, 3, 2.5), 1e-8);
  }

  rows = rows_of(all[1].csv, "x_mm,cylinder_mm,one_polygon_mm,two_polygons_mm,three_polygons_mm");
  EXPECT_EQ(rows.size(), 405U);
  const double R = 15.24, alpha = std::asin(12.7 / R), d = R * std::cos(alpha), h = R - d;
  const double corner = R * std::sin(alpha / 3), top = R * std::cos(alpha / 3) - d;
  EXPECT_NEAR(rows.front()[0], -0.65 * 25.4, 1e-5);
  EXPECT_NEAR(rows.back()[0], 0.65 * 25.4, 1e-5);
  for (const auto& row : rows) {
    const double x = std::fabs(row[0]);
    if (std::fabs(x - 12.7) < 1e-4 || std::fabs(x - corner) < 1e-4) continue;
    const bool is_inside = x < 12.7;
    EXPECT_NEAR(row[1], is_inside ? std::sqrt(R * R - x * x) - d : 0, 1e-5) << x;
    EXPECT_EQ(row[2], 0);
    EXPECT_NEAR(row[3], is_inside ? h * (1 - x / 12.7) : 0, 1e-5) << x;
    EXPECT_NEAR(row[4], !is_inside ? 0 : x < corner ? top : top * (12.7 - x) / (12.7 - corner), 1e-5) << x;
  }

  rows = rows_of(all[2].csv, "theta_deg,radius_mm,centre_z_mm,x_mm,z_mm");
  ASSERT_EQ(rows.size(), 3U * 121);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row[0], (std::array{70, 113, 180})[i / 121]);
    const double half = row[0] * std::numbers::pi / 360, turn = half * (static_cast<double>(i % 121) - 60) / 60;
    EXPECT_NEAR(row[1], 12.7 / std::sin(half), 1e-5);
    EXPECT_NEAR(row[2], -12.7 / std::tan(half), 1e-5);
    EXPECT_NEAR(row[3], row[1] * std::sin(turn), 1e-5);
    EXPECT_NEAR(row[4], row[2] + row[1] * std::cos(turn), 1e-5);
  }

  for (const std::size_t figure : {3U, 4U}) {
    rows = rows_of(all[figure].csv,
                   figure == 3 ? "radius_mil,height_mm" : "radius_mil,one_polygon_deg,two_polygons_deg,three_polygons_deg");
    ASSERT_EQ(rows.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(rows[i][0], 600 + 200.0 * static_cast<double>(i));
      const double mm = rows[i][0] * 0.0254, degrees = 2 * std::asin(12.7 / mm) * 180 / std::numbers::pi;
      if (figure == 3)
        EXPECT_NEAR(rows[i][1], mm - std::sqrt(mm * mm - 12.7 * 12.7), 1e-5);
      else
        for (std::size_t n = 1; n <= 3; ++n) EXPECT_NEAR(rows[i][n], degrees / static_cast<double>(n), 1e-5);
    }
    EXPECT_TRUE(has(all[figure].picture.commands, "set xrange [550:1450]\n"));
  }
  EXPECT_TRUE(has(all[4].picture.commands,
                  "plot $curve using 1:2 with lines lw 1.6 lc rgb '#0072b2' notitle, $points using 1:2 with points pt 7 ps 0.8 "
                  "lc rgb '#0072b2' title 'one polygon', $curve using 1:3 with lines lw 1.6 lc rgb '#d55e00' notitle, $points "
                  "using 1:3 with points pt 7 ps 0.8 lc rgb '#d55e00' title 'two polygons', $curve using 1:4 with lines lw 1.6 "
                  "lc rgb '#009e73' notitle, $points using 1:4 with points pt 7 ps 0.8 lc rgb '#009e73' title 'three "
                  "polygons'\n"));
}

TEST(panels, are_of_one_size_where_stiffness_and_bump_are) {
  const Parameters bump{15.24F, 25.4F, 0.5F};
  const Drawn wall(LawId::wall, {.stiffness = 0.5F}), one(LawId::bump_2p, bump), other(LawId::bump_3p, bump),
      wide(LawId::bump_3p, {15.24F, 26, 0.5F}), stiff(LawId::bump_3p, {15.24F, 25.4F, 1});
  EXPECT_TRUE(are_one_size({wall, one, other}));
  EXPECT_FALSE(are_one_size({wall, one, wide}));
  EXPECT_FALSE(are_one_size({wall, one, stiff}));
  EXPECT_FALSE(are_one_size({Drawn(LawId::wall, {.stiffness = 0.75F}), one}));
  EXPECT_TRUE(contains({wall, one}, {LawId::bump_2p, LawId::bump_3p}));
  EXPECT_FALSE(contains({wall, one}, {LawId::bump_3p}));
  EXPECT_EQ(wall.reach(), 9.7);
  EXPECT_NEAR(one.reach(), 16.51, 1e-5);
  EXPECT_EQ(heights(wall).low, -4.7);
  EXPECT_EQ(heights(wall).high, 1.3);
  EXPECT_NEAR(heights(one).low, -0.21 * 25.4, 1e-5);
  EXPECT_NEAR(heights(one).high, 15.24 - std::sqrt(15.24 * 15.24 - 12.7 * 12.7) + 0.06 * 25.4, 1e-5);
  EXPECT_EQ(profile_depths({wall, one}), (std::array{0.5, 1.0, 2.0}));
  const Drawn small(LawId::bump_2p, {4, 6, 0.5F});
  EXPECT_EQ(profile_depths({one, small}), (std::array{0.25, 0.5, 1.0}));
  // 241 places less both ends, which binary32 rounds beyond the reach; and two beside each of the lines x = 0 and |x| = w/2.
  const std::vector<Sample> samples = across(one);
  EXPECT_EQ(samples.size(), 239U + 6);
  EXPECT_TRUE(std::is_sorted(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.x < b.x; }));
  EXPECT_EQ(std::count_if(samples.begin(), samples.end(), [](const Sample& sample) { return sample.after_jump; }), 3);
  for (const Sample& sample : samples)
    if (sample.after_jump) {
      EXPECT_NEAR(std::min(std::fabs(sample.x), std::fabs(std::fabs(sample.x) - 12.7F)), 0, 1e-5);
    }
}

}  // namespace
}  // namespace forceshade::properties
