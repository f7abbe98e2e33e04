// SPDX-License-Identifier: BSD-3-Clause
#include "report/thesis_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "forceshade/reference.h"
#include "reference/estimates.h"
#include "reference/theta_critical.h"
#include "report/html.h"
#include "report/panels.h"
#include "report/pictures.h"

namespace forceshade::properties {
namespace {

// Above the figure, in one row or more.
std::string title(const std::string& rows) {
  return "set title \"" + rows + "\" font ',11' offset 0, 1.5\n";
}

constexpr double kMil = 0.0254;  // mm
constexpr std::array<const char*, 3> kColours{"#0072b2", "#d55e00", "#009e73"};

Parameters bump_of(double mil) {
  return {static_cast<float>(mil * kMil), kThesisWidth, 0.5F};
}

// Evenly spaced radii through all of the thesis's, for a curve.
std::vector<double> radii() {
  std::vector<double> all;
  for (double mil = 500; mil <= 1500; mil += 10) all.push_back(mil);
  return all;
}

bool is_of_the_thesis(double mil) {
  return std::any_of(kThesisRadii.begin(), kThesisRadii.end(), [&](const ThesisRadius& radius) { return radius.mil == mil; });
}

// 2-3: a height map; its heights need not be positive. Which function the thesis drew it does not say: these hills are ours.
ThesisFigure height_map_function() {
  const HeightMap map{{{height::Gaussian{-3, -3, 4, 3}}, {height::Gaussian{4, 3, 3, 2.5F}, true}}};
  const auto law = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, height::Mode::true_height, 1));
  constexpr int kLines = 20;  // from the middle to an edge
  constexpr float kStep = 0.5F;
  std::string csv = "x_mm,y_mm,u_mm\n", block;
  for (int j = -kLines; j <= kLines; ++j) {
    for (int i = -kLines; i <= kLines; ++i) {
      const float x = static_cast<float>(i) * kStep, y = static_cast<float>(j) * kStep;
      const auto U = static_cast<double>(law.estimate({x, y, 0}).gap.mid());
      csv += digits(x, 9) + ',' + digits(y, 9) + ',' + digits(U, 9) + '\n';
      block += plotted(x) + ' ' + plotted(y) + ' ' + plotted(U) + '\n';
    }
    block += '\n';
  }
  const std::string script = "$surface << EOD\n" + block + "EOD\n" + kPlain +
                             title(
                                 "Figure 2-3: a height map, U = a hill of 4 mm and a hollow of 3 mm\\n(ours: the thesis does "
                                 "not print its function)") +
                             "set border 95 lc rgb '#cccccc'\nset xyplane at -4\nset hidden3d\nset view 55, 30, 1, 1.4\n" +
                             range("x", -10, 10) + range("y", -10, 10) +
                             "set xtics offset 0, -0.3\nset zrange [-4:4]\nset ztics 2\n" +
                             "set xlabel '{/:Italic x} (mm)'\nset ylabel '{/:Italic y} (mm)'\n" +
                             "set label 1 '{/:Italic U} (mm)' at graph 0, 0, 1.25 center\n" +
                             "splot $surface with lines lw 0.8 lc rgb '" + kDepthColours[1] + "'\n";
  return {"figure-2-3",
          {{560, 420, "figure-2-3",
            "A height map: a hill of 4 mm and a hollow of 3 mm (not the thesis's own function, which is not printed)"},
           script},
          csv};
}

// 4-2: the nominal surfaces of the four bumps, R = 600 mil.
ThesisFigure nominal_geometries() {
  constexpr std::array kIds{LawId::bump_cylinder, LawId::bump_1p, LawId::bump_2p, LawId::bump_3p};
  constexpr std::array kNames{"cylinder", "one polygon", "two polygons", "three polygons"};
  std::vector<Drawn> laws;
  for (const LawId id : kIds) laws.emplace_back(id, bump_of(600));

  const auto corner = static_cast<double>(laws[3].shape.w_prime / 2), edge = static_cast<double>(laws[0].shape.w / 2);
  std::vector<double> xs{-edge, -corner, corner, edge};
  for (int i = -200; i <= 200; ++i) xs.push_back(i * laws[0].reach() / 200);
  std::sort(xs.begin(), xs.end());
  std::string csv = "x_mm,cylinder_mm,one_polygon_mm,two_polygons_mm,three_polygons_mm\n", block;
  for (const double x : xs) {
    csv += digits(x, 9);
    block += plotted(x);
    for (const Drawn& law : laws) {
      csv += ',' + digits(law.surface(x), 9);
      block += ' ' + plotted(law.surface(x));
    }
    csv += '\n';
    block += '\n';
  }
  std::string script = "$surface << EOD\n" + block + "EOD\n" + kPlain +
                       "set multiplot layout 2, 2 title 'Figure 4-2: nominal geometries, R = 600 mil, w = 1000 mil' font "
                       "',13'\nset size ratio -1\n" +
                       vertical_name("{/:Italic z} (mm)") + range("x", -laws[0].reach(), laws[0].reach()) + range("y", -3, 8) +
                       kXName;
  for (std::size_t i = 0; i < kIds.size(); ++i)
    script += std::string("set title '") + kNames[i] + "' offset 0, -0.5\nplot $surface using 1:" + std::to_string(i + 2) +
              " with filledcurves y=-3 fc rgb '#e3ecf4', '' using 1:" + std::to_string(i + 2) + " with lines lw 2 lc rgb '" +
              kDepthColours[2] + "'\n";
  return {"figure-4-2",
          {{720, 430, "figure-4-2", "Cross sections of the four nominal geometries, R = 600 mil, w = 1000 mil"},
           script + "unset multiplot\n"},
          csv};
}

// 5-1: three constant-curvature bumps of one width. The thesis names the angles of the outer two; the middle one is ours.
ThesisFigure constant_curvature() {
  constexpr std::array kAngles{70, 113, 180};  // degrees subtended
  const double half = static_cast<double>(kThesisWidth) / 2;
  std::string csv = "theta_deg,radius_mm,centre_z_mm,x_mm,z_mm\n", script = kPlain;
  std::string panels =
      "set multiplot layout 1, 3 title 'Figure 5-1: bumps of constant curvature, w = 1000 mil' font ',13'\nset size ratio "
      "-1\nunset border\nunset tics\n" +
      range("x", -19, 19) + range("y", -22, 14);
  for (const int angle : kAngles) {
    const double alpha = angle * std::numbers::pi / 360, radius = half / std::sin(alpha), centre = -radius * std::cos(alpha);
    std::string block = "-19 0\n";
    for (int i = -60; i <= 60; ++i) {
      const double turn = alpha * i / 60, x = radius * std::sin(turn), z = centre + radius * std::cos(turn);
      block += plotted(x) + ' ' + plotted(z) + '\n';
      csv += std::to_string(angle) + ',' + digits(radius, 9) + ',' + digits(centre, 9) + ',' + digits(x, 9) + ',' +
             digits(z, 9) + '\n';
    }
    const std::string name = "$bump" + std::to_string(angle);
    script += name + " << EOD\n" + block + "19 0\nEOD\n";
    panels += "set title 'θ = " + std::to_string(angle) + "°'\nset object 1 circle at 0, " + plotted(centre) +
              " size 0.5 fc rgb '#222222' fs solid\n" + "set arrow 1 from 0, " + plotted(centre) + " to " + plotted(-half) +
              ", 0 nohead lc rgb '#d55e00'\n" + "set arrow 2 from 0, " + plotted(centre) + " to " + plotted(half) +
              ", 0 nohead lc rgb '#d55e00'\n" + "plot " + name + " with lines lw 2 lc rgb '" + kDepthColours[2] + "'\n";
  }
  return {"figure-5-1",
          {{720, 290, "figure-5-1",
            "Profiles of three constant-curvature bumps of one width, subtending 70, 113 (R = 600 mil; not printed) and 180 "
            "degrees"},
           script + panels + "unset multiplot\n"},
          csv};
}

// Curves over the radius, with the thesis's five radii as points.
ThesisFigure over_radius(const std::string& name, const std::string& heading, const std::string& description,
                         const std::string& vertical, const std::vector<std::string>& columns,
                         const std::vector<std::string>& titles,
                         const std::function<std::string(double mil, std::size_t column)>& value) {
  std::string csv = "radius_mil", block, points;
  for (const std::string& column : columns) csv += ',' + column;
  csv += '\n';
  for (const double mil : radii()) {
    std::string row = plotted(mil);
    for (std::size_t i = 0; i < columns.size(); ++i) row += ' ' + value(mil, i);
    block += row + '\n';
    if (!is_of_the_thesis(mil)) continue;
    points += row + '\n';
    std::replace(row.begin(), row.end(), ' ', ',');
    csv += row + '\n';
  }
  std::string script = "$curve << EOD\n" + block + "EOD\n$points << EOD\n" + points + "EOD\n" + kPlain + title(heading) +
                       "set xlabel 'radius (mil)' textcolor rgb '#333333'\n" + range("x", 550, 1450) + "set yrange [0:*]\n" +
                       "set lmargin 9\nset tmargin 6\n" + vertical_name(vertical.c_str()) +
                       (titles.size() > 1 ? "set key top right\n" : "") + "plot ";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string column = std::to_string(i + 2), colour = kColours[i];
    script += (i > 0 ? ", " : "") + ("$curve using 1:" + column) + " with lines lw 1.6 lc rgb '" + colour + "' notitle, " +
              "$points using 1:" + column + " with points pt 7 ps 0.8 lc rgb '" + colour + "' title '" + titles[i] + "'";
  }
  return {name, {{520, 340, name, description}, script + '\n'}, csv};
}

// 5-4: the height of the bump.
ThesisFigure heights_over_radius() {
  return over_radius("figure-5-4", "Figure 5-4: height of the bump, w = 1000 mil\\npoints: the radii of the thesis",
                     "The height of the bump against its radius, w = 1000 mil", "height (mm)", {"height_mm"}, {"height"},
                     [](double mil, std::size_t) { return reference::geometry(bump_of(mil), 9).h; });
}

// 5-5: the angle that each polygon subtends.
ThesisFigure angles_over_radius() {
  return over_radius("figure-5-5", "Figure 5-5: angle for each polygon, w = 1000 mil\\npoints: the radii of the thesis",
                     "The angle that the bump subtends over its number of polygons, against its radius, w = 1000 mil",
                     "degrees for each polygon", {"one_polygon_deg", "two_polygons_deg", "three_polygons_deg"},
                     {"one polygon", "two polygons", "three polygons"}, [](double mil, std::size_t i) {
                       return reference::subtended_degrees(bump_of(mil), static_cast<unsigned>(i) + 1, 9);
                     });
}

}  // namespace

std::vector<ThesisFigure> thesis_figures() {
  return {height_map_function(), nominal_geometries(), constant_curvature(), heights_over_radius(), angles_over_radius()};
}

}  // namespace forceshade::properties
