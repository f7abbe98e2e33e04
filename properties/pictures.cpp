// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/pictures.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "forceshade/properties/binary32.h"
#include "forceshade/properties/html.h"
#include "forceshade/reference/energy.h"

namespace forceshade::properties {

namespace {

// A plot of this many pixels across, with these margins, in which one millimetre is as long up as across.
struct Frame {
  int width;
  double left, right, top, bottom;  // px

  int height(double reach, const Heights& shown) const {
    return static_cast<int>(std::ceil(top + bottom + (width - left - right) * (shown.high - shown.low) / (2 * reach)));
  }
  std::string axes(double reach, const Heights& shown) const {
    const double across = width, up = height(reach, shown);
    return margins(left / across, 1 - right / across, 1 - top / up, bottom / up) + range("x", -reach, reach) +
           range("y", shown.low, shown.high) + kXName + vertical_name("{/:Italic z} (mm)");
  }
};

std::string surface_block(const Drawn& drawn) {
  std::string block = "$surface << EOD\n";
  for (const Sample& sample : across(drawn)) {
    const auto x = static_cast<double>(sample.x);
    block += plotted(x) + ' ' + plotted(drawn.surface(x)) + '\n';
  }
  return block + "EOD\n";
}

}  // namespace

std::array<double, 3> profile_depths(const std::vector<Drawn>& laws) {
  double deepest = 2;
  for (const Drawn& drawn : laws)
    if (drawn.shape.R > 0) deepest = std::min(deepest, static_cast<double>(drawn.shape.R) / 4);
  return {deepest / 4, deepest / 2, deepest};
}

ForceProfile::ForceProfile(const Drawn& drawn, const std::array<double, 3>& depths) {
  for (const double depth : depths) {
    for (const auto& [x, after_jump] : across(drawn)) {
      const Eigen::Vector3f force = drawn.law.force({x, 0, static_cast<float>(drawn.surface(static_cast<double>(x)) - depth)});
      if (after_jump) block += '\n';
      block += digits(static_cast<double>(x), 9) + ' ' + plotted(static_cast<double>(force.x())) + ' ' +
               plotted(static_cast<double>(force.z())) + '\n';
      side = std::max(side, std::fabs(static_cast<double>(force.x())));
      up = std::max(up, static_cast<double>(force.z()));
    }
    block += "\n\n";
  }
}

Picture force_profile(const Drawn& drawn, const ForceProfile& profile, double side, double up) {
  side = 1.08 * (side > 0 ? side : 1);
  up = 1.08 * (up > 0 ? up : 1);
  const auto plots = [](int column) {
    std::string text;
    for (std::size_t i = 0; i < kDepthColours.size(); ++i)
      text += (i == 0 ? "plot " : ", ") + ("$force index " + std::to_string(i)) + " using 1:" + std::to_string(column) +
              " with lines lw 1.8 lc rgb '" + kDepthColours[i] + "'";
    return text + '\n';
  };
  const std::string script = "$force << EOD\n" + profile.block + "EOD\n" + kPlain + range("x", -drawn.reach(), drawn.reach()) +
                             "set multiplot\n" + margins(0.145, 0.975, 0.91, 0.595) + range("y", 0, up) + ticks("y", up, 4) +
                             "set format x ''\n" + vertical_name("{/:Italic F}_z (N)") + plots(3) +
                             margins(0.145, 0.975, 0.475, 0.15) + range("y", -side, side) + ticks("y", side, 2) +
                             "set format x '%g'\n" + kXName + "set xzeroaxis lc rgb '#bbbbbb' lt 1\n" +
                             vertical_name("{/:Italic F}_x (N)") + plots(2) + "unset multiplot\n";
  return {{350, 290, "force-" + drawn.name(), "Force of " + drawn.name() + " against x at three depths: F_z above, F_x below"},
          script};
}

Picture cross_section(const Drawn& drawn) {
  const bool is_bump = drawn.shape.w > 0;
  LawResult round = drawn.result;
  round.law = LawId::bump_cylinder;
  const std::optional<Drawn> cylinder = is_bump && drawn.result.law != round.law ? std::optional<Drawn>(round) : std::nullopt;
  const auto w = static_cast<double>(drawn.shape.w), h = static_cast<double>(drawn.shape.h);
  const double low = is_bump ? -0.12 * w : -3, high = is_bump ? h + 0.06 * w : 1;
  std::vector<double> xs;
  for (int i = 0; i <= 160; ++i) xs.push_back(drawn.reach() * (i / 80.0 - 1));
  for (const long double corner : {drawn.shape.w / 2, drawn.shape.w_prime / 2})
    for (const double sign : {-1.0, 1.0}) xs.push_back(sign * static_cast<double>(corner));
  std::sort(xs.begin(), xs.end());
  std::string block;
  for (const double x : xs)
    block += plotted(x) + ' ' + plotted(drawn.surface(x)) + ' ' +
             plotted(cylinder && std::fabs(x) <= w / 2 ? cylinder->surface(x) : std::nan("")) + '\n';

  const Frame frame{270, 48, 8, 26, 47};
  const std::string script =
      "$surface << EOD\n" + block + "EOD\n" + kPlain + frame.axes(drawn.reach(), {low, high}) + ticks("y", high - low, 5) +
      "plot $surface using 1:2 with filledcurves y=" + plotted(low) +
      " fc rgb '#e3ecf4', '' using 1:2 with lines lw 2 lc rgb '" + kDepthColours[2] + "'" +
      (cylinder ? std::string(", '' using 1:3 with lines lw 1.4 dt (4,3) lc rgb '") + kCurveColour + "'" : "") + '\n';
  return {{frame.width, frame.height(drawn.reach(), {low, high}), "surface-" + drawn.name(),
           "Cross section of the nominal surface of " + drawn.name()},
          script};
}

Picture direction_field(const Drawn& drawn) {
  constexpr int kColumns = 33;
  const Heights shown = heights(drawn);
  const double step = 2 * drawn.reach() / kColumns;
  std::string arrows;
  for (double z = shown.low + step / 2; z < shown.high; z += step)
    for (int column = 0; column < kColumns; ++column) {
      const double x = (column + 0.5) * step - drawn.reach();
      const Eigen::Vector3d force = drawn.law.force({static_cast<float>(x), 0, static_cast<float>(z)}).cast<double>();
      const double size = force.norm();
      if (size == 0) continue;
      const Eigen::Vector3d arrow = 0.85 * step / size * force;
      arrows +=
          plotted(x) + ' ' + plotted(z) + ' ' + plotted(arrow.x()) + ' ' + plotted(arrow.z()) + ' ' + plotted(size) + '\n';
    }
  const Frame frame{680, 52, 118, 26, 47};
  const std::string script = "$arrows << EOD\n" + arrows + "EOD\n" + surface_block(drawn) + kPlain +
                             frame.axes(drawn.reach(), shown) + ticks("y", shown.high - shown.low, 5) +
                             "set palette defined (0 '" + kDepthColours[0] + "', 1 '" + kDepthColours[1] + "', 2 '" +
                             kDepthColours[2] + "')\nset cblabel 'N' offset 0.2\nset cbrange [0:*]\n" +
                             "plot $arrows using 1:2:3:4:5 with vectors head size graph 0.008,22 filled lw 1.2 lc palette, "
                             "$surface with lines lw 1.4 lc rgb '#222222'\n";
  return {{frame.width, frame.height(drawn.reach(), shown), "directions-" + drawn.name(),
           "Directions and sizes of the force of " + drawn.name() + " over x and z"},
          script};
}

Picture energy_map(const Drawn& drawn) {
  constexpr int kColumns = 84, kRows = 42;
  const Heights shown = heights(drawn);
  const double dx = 2 * drawn.reach() / kColumns, dz = (shown.high - shown.low) / kRows;
  const double left = dx / 2 - drawn.reach(), bottom = shown.low + dz / 2;
  std::string matrix;
  std::vector<double> sizes;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double x = left + dx * column, z = bottom + dz * row;
      double density = std::nan("");
      if (z < drawn.surface(x)) {
        const auto [low, high] = reference::binary64(
            reference::circulation_density(drawn.reference, {static_cast<float>(x), static_cast<float>(z)}));
        density = low + (high - low) / 2;
        sizes.push_back(std::fabs(density));
      }
      matrix += plotted(density) + (column + 1 < kColumns ? ' ' : '\n');
    }
  // Where w = 2R the density has no bound at the rim: nearly all of it sets the scale.
  const auto nearly_all = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 98 / 100);
  std::nth_element(sizes.begin(), nearly_all, sizes.end());
  const double scale = *nearly_all > 0 ? *nearly_all : 1;

  std::string lines;
  for (const reference::LineTerm& line : reference::line_terms(drawn.reference))
    for (const double sign : {-1.0, 1.0}) {
      const double x = sign * reference::binary64(line.x)[0];
      lines += plotted(x) + ' ' + plotted(shown.low) + '\n' + plotted(x) + ' ' + plotted(drawn.surface(x)) + "\n\n";
    }
  const Frame frame{680, 52, 118, 26, 47};
  const std::string script =
      "$density << EOD\n" + matrix + "EOD\n$lines << EOD\n" + (lines.empty() ? "NaN NaN\n" : lines) + "EOD\n" +
      surface_block(drawn) + kPlain + frame.axes(drawn.reach(), shown) + ticks("y", shown.high - shown.low, 5) +
      "set palette defined (0 '#2166ac', 1 '#f4f1ea', 2 '#b35806')\nset cbrange [" + plotted(-scale) + ':' + plotted(scale) +
      "]\nset cblabel 'mJ/mm²' offset 0.2\nplot $density using (" + plotted(left) + "+$1*" + plotted(dx) + "):(" +
      plotted(bottom) + "+$2*" + plotted(dz) +
      "):3 matrix with image, $lines with lines lw 1.6 dt (5,4) lc rgb '#222222', $surface with lines lw 1.4 lc rgb "
      "'#222222'\n";
  return {{frame.width, frame.height(drawn.reach(), shown), "energy-" + drawn.name(),
           "Energy that small loops are paid for their area by " + drawn.name() + ", over x and z"},
          script};
}

}  // namespace forceshade::properties
