// SPDX-License-Identifier: BSD-3-Clause
#include "report/pictures.h"

#include <algorithm>
#include <cmath>

#include "properties/binary32.h"
#include "report/html.h"

namespace forceshade::properties {

namespace {

int heading_height(const SideView& view) {
  return view.heading.title.empty() ? 0 : kHeadingHeight;
}

// A plot of this many pixels across, with these margins, in which one millimetre is as long up as across.
struct Frame {
  int width;
  double left, right, top, bottom;  // px

  // px
  double up(const SideView& view, const Heights& shown) const {
    return (width - left - right) * (shown.high - shown.low) / (view.right - view.left);
  }
  int height(const SideView& view, const Heights& shown) const {
    return heading_height(view) + static_cast<int>(std::ceil(top + bottom + up(view, shown)));
  }
  std::string axes(const SideView& view, const Heights& shown) const {
    const double across = width, high = height(view, shown);
    return margins(left / across, 1 - right / across, 1 - (heading_height(view) + top) / high, bottom / high) +
           range("x", view.left, view.right) + range("y", shown.low, shown.high) +
           ticks("x", view.right - view.left, std::clamp(static_cast<int>((across - left - right) / 44), 1, 8)) +
           ticks("y", shown.high - shown.low, std::clamp(static_cast<int>(up(view, shown) / 20), 1, 5)) + kXName +
           vertical_name("{/:Italic z} (mm)") + heading_commands(view.heading, width, static_cast<int>(high));
  }
  // A box of colours beside the plot, with what they mean above it, where no number of its own can be.
  std::string colours(const SideView& view, const Heights& shown, const std::string& meaning) const {
    const double across = width, high = height(view, shown);
    const std::string x = plotted(1 - (right - 16) / across);
    return "set colorbox user origin screen " + x + ", screen " + plotted(bottom / high) + " size screen " +
           plotted(18 / across) + ", screen " + plotted(up(view, shown) / high) + "\nset label 103 " + quoted(meaning) +
           " at screen " + x + ", screen " + plotted(1 - (heading_height(view) + top - 18) / high) +
           " left textcolor rgb '#333333'\n";
  }
};

std::string surface_block(const SideView& view) {
  std::string block = "$surface << EOD\n";
  for (const Sample& sample : view.across) {
    const auto x = static_cast<double>(sample.x);
    block += plotted(x) + ' ' + plotted(view.surface(x)) + '\n';
  }
  return block + "EOD\n";
}

}  // namespace

std::string heading_commands(const Heading& heading, int width, int height) {
  if (heading.title.empty()) return "";
  const auto row = [&](int px) { return "screen " + plotted(8.0 / width) + ", screen " + plotted(1 - px / double(height)); };
  return "set label 101 " + quoted(heading.title) + " noenhanced at " + row(14) + " left font ',13'\n" + "set label 102 " +
         quoted(heading.parameters) + " noenhanced at " + row(33) + " left font ',10'\n" + "set key at " + row(52) +
         " left center vertical maxrows 1 Left reverse samplen 1.5 width 0 font ',10'\n";
}

std::array<double, 3> profile_depths(const std::vector<Drawn>& laws) {
  double deepest = 2;
  for (const Drawn& drawn : laws)
    if (drawn.shape.R > 0) deepest = std::min(deepest, static_cast<double>(drawn.shape.R) / 4);
  return {deepest / 4, deepest / 2, deepest};
}

ForceProfile::ForceProfile(const SideView& view, const std::array<double, 3>& depths) {
  for (const double depth : depths) {
    for (const auto& [x, after_jump] : view.across) {
      const Eigen::Vector3f force = view.force(x, static_cast<float>(view.surface(static_cast<double>(x)) - depth));
      if (after_jump) block += '\n';
      block += digits(static_cast<double>(x), 9) + ' ' + plotted(static_cast<double>(force.x())) + ' ' +
               plotted(static_cast<double>(force.z())) + '\n';
      side = std::max(side, std::fabs(static_cast<double>(force.x())));
      up = std::max(up, static_cast<double>(force.z()));
    }
    block += "\n\n";
  }
}

Picture force_profile(const SideView& view, const ForceProfile& profile, double side, double up) {
  side = 1.08 * (side > 0 ? side : 1);
  up = 1.08 * (up > 0 ? up : 1);
  const auto plots = [&](int column) {
    std::string text;
    for (std::size_t i = 0; i < kDepthColours.size(); ++i)
      text += (i == 0 ? "plot " : ", ") + ("$force index " + std::to_string(i)) + " using 1:" + std::to_string(column) +
              " with lines lw 1.8 lc rgb '" + kDepthColours[i] + "' title '" + digits(view.depths[i], 3) + " mm deep'";
    return text + '\n';
  };
  // px; without a heading there is no legend either.
  constexpr int kLeft = 58, kRight = 9, kTop = 27, kPanel = 91, kBetween = 35, kBottom = 48;
  const int width = heading_height(view) > 0 ? 470 : 350;
  const int above = heading_height(view), height = above + kTop + 2 * kPanel + kBetween + kBottom;
  const auto panel = [&](int from_top) {
    return margins(kLeft / double(width), 1 - kRight / double(width), 1 - from_top / double(height),
                   1 - (from_top + kPanel) / double(height));
  };
  const std::string script =
      "$force << EOD\n" + profile.block + "EOD\n" + kPlain + range("x", view.left, view.right) +
      ticks("x", view.right - view.left, 7) + heading_commands(view.heading, width, height) + "set multiplot\n" +
      panel(above + kTop) + range("y", 0, up) + ticks("y", up, 4) + "set format x ''\n" + vertical_name("{/:Italic F}_z (N)") +
      plots(3) + "unset key\nunset label 101\nunset label 102\n" + panel(above + kTop + kPanel + kBetween) +
      range("y", -side, side) + ticks("y", side, 2) + "set format x '%g'\n" + kXName + "set xzeroaxis lc rgb '#bbbbbb' lt 1\n" +
      vertical_name("{/:Italic F}_x (N)") + plots(2) + "unset multiplot\n";
  return {{width, height, "force-" + view.name, "Force of " + view.name + " against x at three depths: F_z above, F_x below"},
          script};
}

Picture cross_section(const SideView& view) {
  std::string block;
  bool stands_for_another = false;
  for (const Sample& sample : view.across) {
    const auto x = static_cast<double>(sample.x);
    const double other = view.stands_for(x);
    stands_for_another = stands_for_another || !std::isnan(other);
    block += plotted(x) + ' ' + plotted(view.surface(x)) + ' ' + plotted(other) + '\n';
  }
  const Heights& shown = view.nominal;
  const Frame frame{heading_height(view) > 0 ? 460 : 270, 48, 8, 26, 47};
  const std::string script = "$surface << EOD\n" + block + "EOD\n" + kPlain + frame.axes(view, shown) +
                             "plot $surface using 1:2 with filledcurves y=" + plotted(shown.low) +
                             " fc rgb '#e3ecf4' notitle, '' using 1:2 with lines lw 2 lc rgb '" + kDepthColours[2] +
                             "' title 'where the force begins'" +
                             (stands_for_another ? std::string(", '' using 1:3 with lines lw 1.4 dt (4,3) lc rgb '") +
                                                       kCurveColour + "' title 'the shape it stands for'"
                                                 : "") +
                             '\n';
  return {
      {frame.width, frame.height(view, shown), "surface-" + view.name, "Cross section of the nominal surface of " + view.name},
      script};
}

Picture direction_field(const SideView& view) {
  constexpr int kColumns = 33;
  const Heights& shown = view.shown;
  const double step = (view.right - view.left) / kColumns;
  std::string arrows;
  for (double z = shown.low + step / 2; z < shown.high; z += step)
    for (int column = 0; column < kColumns; ++column) {
      const double x = view.left + (column + 0.5) * step;
      const Eigen::Vector3d force = view.force(static_cast<float>(x), static_cast<float>(z)).cast<double>();
      const double size = force.norm();
      if (size == 0) continue;
      const Eigen::Vector3d arrow = 0.85 * step / size * force;
      arrows +=
          plotted(x) + ' ' + plotted(z) + ' ' + plotted(arrow.x()) + ' ' + plotted(arrow.z()) + ' ' + plotted(size) + '\n';
    }
  const Frame frame{680, 52, 118, 26, 47};
  const std::string script = "$arrows << EOD\n" + arrows + "EOD\n" + surface_block(view) + kPlain + frame.axes(view, shown) +
                             frame.colours(view, shown, "force (N)") + "set palette defined (0 '" + kDepthColours[0] +
                             "', 1 '" + kDepthColours[1] + "', 2 '" + kDepthColours[2] + "')\nset cbrange [0:*]\n" +
                             "plot $arrows using 1:2:3:4:5 with vectors head size graph 0.008,22 filled lw 1.2 lc palette "
                             "title 'force', $surface with lines lw 1.4 lc rgb '#222222' title 'where the force begins'\n";
  return {{frame.width, frame.height(view, shown), "directions-" + view.name,
           "Directions and sizes of the force of " + view.name + " over x and z"},
          script};
}

Picture energy_map(const SideView& view) {
  constexpr int kColumns = 84, kRows = 42;
  const Heights& shown = view.shown;
  const double dx = (view.right - view.left) / kColumns, dz = (shown.high - shown.low) / kRows;
  const double left = view.left + dx / 2, bottom = shown.low + dz / 2;
  std::string matrix;
  std::vector<double> sizes;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double x = left + dx * column, z = bottom + dz * row;
      double density = std::nan("");
      if (z < view.surface(x)) {
        density = view.density(x, z);
        sizes.push_back(std::fabs(density));
      }
      matrix += plotted(density) + (column + 1 < kColumns ? ' ' : '\n');
    }
  // If w = 2R, the density has no bound at the rim: nearly all of it sets the scale.
  const auto nearly_all = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 98 / 100);
  std::nth_element(sizes.begin(), nearly_all, sizes.end());
  const double scale = *nearly_all > 0 ? *nearly_all : 1;

  std::string lines;
  for (const double x : view.jumps)
    lines += plotted(x) + ' ' + plotted(shown.low) + '\n' + plotted(x) + ' ' + plotted(view.surface(x)) + "\n\n";
  const Frame frame{680, 52, 118, 26, 47};
  const std::string script =
      "$density << EOD\n" + matrix + "EOD\n$lines << EOD\n" + (lines.empty() ? "NaN NaN\n" : lines) + "EOD\n" +
      surface_block(view) + kPlain + frame.axes(view, shown) + frame.colours(view, shown, "mJ/mm²") +
      "set palette defined (0 '#2166ac', 1 '#f4f1ea', 2 '#b35806')\nset cbrange [" + plotted(-scale) + ':' + plotted(scale) +
      "]\nplot $density using (" + plotted(left) + "+$1*" + plotted(dx) + "):(" + plotted(bottom) + "+$2*" + plotted(dz) +
      "):3 matrix with image notitle, $surface with lines lw 1.4 lc rgb '#222222' title 'where the force begins', $lines with "
      "lines lw 1.6 dt (5,4) lc rgb '#222222' " +
      (lines.empty() ? "notitle" : "title 'where it jumps'") + '\n';
  return {{frame.width, frame.height(view, shown), "energy-" + view.name,
           "Energy that small loops give for their area by " + view.name + ", over x and z"},
          script};
}

}  // namespace forceshade::properties
