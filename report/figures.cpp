// SPDX-License-Identifier: BSD-3-Clause
#include "report/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "properties/binary32.h"
#include "reference/estimates.h"
#include "report/gnuplot.h"
#include "report/html.h"
#include "report/panels.h"
#include "report/pictures.h"

namespace forceshade::properties {
namespace {

// Okabe and Ito's colours, distinct with any colour vision.
constexpr std::array<const char*, 5> kLawColours{"#0072b2", "#d55e00", "#222222", "#009e73", "#b3589a"};
constexpr std::array<int, 5> kLawMarks{7, 5, 9, 13, 11};
constexpr const char *kBelow = "#2166ac", *kNone = "#ece7dc", *kAbove = "#b35806";

std::string force_figure(int number, const std::vector<Drawn>& laws) {
  const std::array<double, 3> depths = profile_depths(laws);
  std::vector<ForceProfile> profiles;
  for (const Drawn& drawn : laws) profiles.emplace_back(side_view(drawn), depths);
  const bool shared = are_one_size(laws);
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    double side = 0, up = 0;
    for (const ForceProfile& profile : shared ? profiles : std::vector{profiles[i]}) {
      side = std::max(side, profile.side);
      up = std::max(up, profile.up);
    }
    panels.push_back({laws[i].name(), svg_plot(force_profile(side_view(laws[i]), profiles[i], side, up))});
  }

  std::string legend = "depth of the hand below the nominal surface:";
  for (std::size_t i = 0; i < depths.size(); ++i)
    legend += ' ' + legend_line(kDepthColours[i], html_number(depths[i], 3) + "\u202Fmm");
  std::string caption =
      "The hand crosses the bump while it stays at a constant depth below the law’s own nominal surface; every curve is what "
      "the fast path answers";
  caption += shared ? ", and all panels share their axes of force." : "; each panel has its own axes.";
  if (contains(laws, {LawId::bump_2p, LawId::bump_3p}))
    caption += " Look at <i>F</i><sub>x</sub>: polygons push sideways in steps, and a curve breaks where the force jumps.";
  if (contains(laws, {LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded}))
    caption +=
        " Force shading makes <i>F</i><sub>x</sub> one straight ramp, the same on one, two and three polygons, and leaves a "
        "jump only at the rim, |<i>x</i>|\u202F=\u202F<i>w</i>/2.";
  if (contains(laws, {LawId::bump_cylinder}))
    caption += " The bump-cylinder is two objects: near the rim, where the hand is inside both, their forces add up.";
  return figure(number, "three", "Force along the surface", legend, panels, caption);
}

struct SurfacePanel {
  LawId id;
  const char* heading;
};

std::string surface_figure(int number, const Parameters& parameters) {
  constexpr std::array<SurfacePanel, 4> kPanels{{{LawId::bump_cylinder, "cylinder"},
                                                 {LawId::bump_1p, "one polygon"},
                                                 {LawId::bump_2p, "two polygons"},
                                                 {LawId::bump_3p, "three polygons"}}};
  const Drawn cylinder(LawId::bump_cylinder, parameters);
  std::vector<Panel> panels;
  for (const auto& [id, heading] : kPanels) {
    panels.push_back({heading, svg_plot(cross_section(side_view(Drawn(id, parameters))))});
  }
  const auto mm = [](long double size) { return html_number(static_cast<double>(size), 5) + "\u202Fmm"; };
  const LawClaims& shape = cylinder.shape;
  return figure(
      number, "four", "Nominal surfaces",
      legend_line(kDepthColours[2], "where the force begins") +
          legend_line("#d55e00;border-top-style:dashed", "the cylinder they stand for"),
      panels,
      "Cross sections, as long up as across, for <i>R</i> = " + mm(shape.R) + " and <i>w</i> = " + mm(shape.w) +
          ": the cylinder rises <i>h</i> = " + mm(shape.h) + " above the plane, and so does the ridge of two polygons; " +
          "three polygons have a flat top <i>w</i>′ = " + mm(shape.w_prime) + " wide at <i>h</i>′ = " + mm(shape.h_prime) +
          ". One polygon is the plane itself. A shaded law has the surface of the unshaded one: only the direction of its "
          "force differs.");
}

struct ErrorMap {
  static constexpr int kColumns = 64, kRows = 48;
  double left, bottom, dx, dz;  // mm: centre of the first cell, distance of two
  std::string matrix;           // rows from the bottom up; NaN in free space
  double largest = 0;           // ulps
  int cells = 0;

  explicit ErrorMap(const Drawn& drawn) {
    const auto [low, high] = heights(drawn);
    dx = 2 * drawn.reach() / kColumns;
    dz = (high - low) / kRows;
    left = -drawn.reach() + dx / 2;
    bottom = low + dz / 2;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        const double error =
            error_at(drawn, {static_cast<float>(left + dx * column), 0, static_cast<float>(bottom + dz * row)});
        matrix += (std::isnan(error) ? "NaN" : digits(error, 3)) + (column + 1 < kColumns ? ' ' : '\n');
        if (std::isnan(error)) continue;
        ++cells;
        largest = std::max(largest, std::fabs(error));
      }
    }
  }

 private:
  static double error_at(const Drawn& drawn, const Eigen::Vector3f& position) {
    const fast::Evaluation answer = drawn.law.evaluate(position);
    if (finished(answer.status) != Status::contact) return std::nan("");
    // The exact force is known to 60 bits or more; of the errors that leaves open, the smallest.
    const reference::Ball64 exact = drawn.reference.estimate(position).force.z;
    const long double given = answer.force.z(), ulp = 2 * static_cast<long double>(half_spacing(answer.force.z()));
    const long double size = std::max(std::fabs(given - exact.mid()) - exact.rad(), 0.0L);
    return static_cast<double>(std::copysign(size, given - exact.mid()) / ulp);
  }
};

std::string error_svg(const Drawn& drawn, const ErrorMap& map) {
  std::string surface;
  for (const Sample& sample : across(drawn)) {
    const auto x = static_cast<double>(sample.x);
    surface += plotted(x) + ' ' + plotted(drawn.surface(x)) + '\n';
  }
  const std::string script =
      "$error << EOD\n" + map.matrix + "EOD\n$surface << EOD\n" + surface + "EOD\n" + kPlain +
      margins(0.145, 0.975, 0.89, 0.165) + range("x", -drawn.reach(), drawn.reach()) +
      range("y", map.bottom - map.dz / 2, map.bottom + map.dz * (ErrorMap::kRows - 0.5)) + "set palette defined (0 '" + kBelow +
      "', 1 '" + kNone + "', 2 '" + kAbove + "')\nset cbrange [-0.5:0.5]\nunset colorbox\n" + kXName +
      vertical_name("{/:Italic z} (mm)") + "plot $error using (" + plotted(map.left) + "+$1*" + plotted(map.dx) + "):(" +
      plotted(map.bottom) + "+$2*" + plotted(map.dz) + "):3 matrix with image, $surface with lines lw 1.4 lc rgb '#222222'\n";
  return svg_plot({350, 260, "error-" + drawn.name(),
                   "Rounding error of F_z of " + drawn.name() + " over x and z, at most " + digits(map.largest, 4) + " ulp"},
                  script);
}

std::string error_figure(int number, const std::vector<Drawn>& laws) {
  std::vector<Panel> panels;
  double largest = 0;
  int cells = 0;
  std::string without_error;
  for (const Drawn& drawn : laws) {
    const ErrorMap map(drawn);
    panels.push_back({drawn.name() + " <span>largest " + html_number(map.largest, 4) + " ulp</span>", error_svg(drawn, map)});
    if (map.largest == 0) without_error += (without_error.empty() ? "" : ", ") + drawn.name();
    largest = std::max(largest, map.largest);
    cells += map.cells;
  }
  const std::string legend =
      std::string(
          "error of <i>F</i><sub>z</sub>: <span class=\"key\">−½ ulp <svg class=\"scale\" viewBox=\"0 0 160 10\" "
          "aria-hidden=\"true\"><defs><linearGradient id=\"error-scale\"><stop offset=\"0\" stop-color=\"") +
      kBelow + "\"/><stop offset=\".5\" stop-color=\"" + kNone + "\"/><stop offset=\"1\" stop-color=\"" + kAbove +
      "\"/></linearGradient></defs><rect width=\"160\" height=\"10\" fill=\"url(#error-scale)\"/></svg> +½ ulp</span> "
      "<span class=\"key\">white: free space</span>";
  std::string caption =
      "The fast path’s <i>F</i><sub>z</sub> minus the exact one, in units of the last place (ulp) of the binary32 result, at " +
      grouped(static_cast<std::uint64_t>(cells)) +
      " positions in contact; the line is the nominal surface. Noise that fills the whole scale and never leaves it is what "
      "correct rounding looks like; it turns into bands where the force depends on <i>z</i> alone. ";
  caption += largest <= 0.5 ? "The largest error seen is " + digits(largest, 6) + "\u202Fulp: never more than half of one."
                            : "<strong>The largest error seen is " + html_number(largest, 6) +
                                  "\u202Fulp: more than half of one.</strong>";
  if (!without_error.empty())
    caption += " No error at all here, because each product fits into a binary32: " + without_error + '.';
  return figure(number, "three", "Rounding error", legend, panels, caption);
}

struct EnergyPlot {
  std::vector<const Drawn*> active;
  std::string blocks;  // depth, bound, measured, relative difference in parts per million; one index per law
  std::vector<double> depths;
  double low = HUGE_VAL, high = 0;  // mJ
  double below = 0, above = 0;      // parts per million
  bool all_positive = true;

  explicit EnergyPlot(const std::vector<Drawn>& laws) {
    for (const Drawn& drawn : laws) {
      const Findings& law = drawn.findings;
      if (law.conservative || law.energy.empty()) continue;
      active.push_back(&drawn);
      for (const LoopEnergy& loop : law.energy) {
        const double difference = 1e6 * (loop.measured_mJ / loop.witness_mJ - 1);
        blocks += plotted(loop.depth_mm) + ' ' + plotted(loop.bound_mJ[1]) + ' ' + plotted(loop.measured_mJ) + ' ' +
                  plotted(difference) + '\n';
        depths.push_back(loop.depth_mm);
        for (const double energy : {loop.bound_mJ[1], loop.measured_mJ}) {
          all_positive = all_positive && energy > 0;
          if (!(energy > 0) || !std::isfinite(energy)) continue;
          low = std::min(low, energy);
          high = std::max(high, energy);
        }
        if (!std::isfinite(difference)) continue;
        below = std::min(below, difference);
        above = std::max(above, difference);
      }
      blocks += "\n\n";
    }
    std::sort(depths.begin(), depths.end());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  }

  bool is_empty() const { return active.empty() || !(high > 0) || !(depths.front() > 0); }

  std::string axes(double right) const {
    std::string tics;
    for (const double depth : depths)
      tics += (tics.empty() ? "'" : ", '") + digits(depth, depth < 0.1 ? 2 : 3) + "' " + plotted(depth);
    return "$energy << EOD\n" + blocks + "EOD\n" + kPlain + margins(0.105, right, 0.9, 0.15) + "set logscale x\n" +
           range("x", depths.front() / 1.15, depths.back() * 1.15) + (depths.size() <= 8 ? "set xtics (" + tics + ")\n" : "") +
           "set xlabel \"depth of the loop (mm)\" offset 0, 0.5 textcolor rgb '#333333'\nset xtics offset 0, 0.3\n";
  }

  // The laws' names beside their last points, moved apart where they would touch.
  std::string names(double bottom, double top) const {
    constexpr double kLine = 0.062;  // of the plot's height
    std::vector<std::pair<double, std::size_t>> places;
    for (std::size_t i = 0; i < active.size(); ++i) {
      const double energy = std::clamp(active[i]->findings.energy.back().measured_mJ, bottom, top);
      places.emplace_back(std::log(energy / bottom) / std::log(top / bottom), i);
    }
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i) places[i].first = std::max(places[i].first, places[i - 1].first + kLine);
    std::string labels;
    for (const auto& [height, i] : places)
      labels += "set label " + std::to_string(i + 10) + " '" + active[i]->name() + "' at graph 1.01, graph " + plotted(height) +
                " textcolor rgb '" + kLawColours[i % kLawColours.size()] + "'\n";
    return labels;
  }

  std::string marks(std::size_t i, int column) const {
    return "$energy index " + std::to_string(i) + " using 1:" + std::to_string(column) + " with points pt " +
           std::to_string(kLawMarks[i % kLawMarks.size()]) + " ps 0.8 lc rgb '" + kLawColours[i % kLawColours.size()] + "'";
  }

  std::string energy_svg() const {
    const double bottom = low / 1.6, top = high * 1.6;
    std::string plots;
    for (std::size_t i = 0; i < active.size(); ++i)
      plots += (i > 0 ? ", " : "plot ") + ("$energy index " + std::to_string(i)) + " using 1:2 with lines lw 1.6 lc rgb '" +
               kLawColours[i % kLawColours.size()] + "', " + marks(i, 3);
    return svg_plot({480, 330, "energy", "Energy per loop against the depth of the loop, bound and measured"},
                    axes(0.73) + "set logscale y\n" + range("y", bottom, top) + vertical_name("energy per loop (mJ)") +
                        names(bottom, top) + plots + '\n');
  }

  std::string difference_svg() const {
    const double room = above > below ? 0.12 * (above - below) : 1;
    std::string plots = "plot 0 with lines lw 1 lc rgb '#bbbbbb'";
    for (std::size_t i = 0; i < active.size(); ++i)
      plots += ", $energy index " + std::to_string(i) + " using 1:4 with lines lw 1 lc rgb '" +
               kLawColours[i % kLawColours.size()] + "', " + marks(i, 4);
    return svg_plot({480, 330, "energy-difference",
                     "Energy of the fast path against the exact law around the same loops, relative difference"},
                    axes(0.97) + range("y", below - room, above + room) +
                        vertical_name("fast path / exact law − 1 (parts per million)") + plots + '\n');
  }
};

std::string energy_figure(int number, const std::vector<Drawn>& laws, const EnergyPlot& plot) {
  std::string conservative;
  double rest = 0;
  for (const Drawn& drawn : laws) {
    if (!drawn.findings.conservative) continue;
    conservative += (conservative.empty() ? "" : ", ") + drawn.name();
    for (const LoopEnergy& loop : drawn.findings.energy) rest = std::max(rest, std::fabs(loop.measured_mJ));
  }
  std::string caption =
      "Energy that an active law gives to the hand each time it goes round. Lines: the most that a simple loop no deeper can "
      "give, "
      "joined between the depths that were walked. Points: what the fast path gave around the witness, a loop that reaches "
      "99\u202F% of it or more. The second panel, with the same marks, compares that with the exact law around the same "
      "loop: they differ by at most " +
      html_number(std::max(-plot.below, plot.above), 2) + " parts per million.";
  if (contains(laws, {LawId::bump_2p, LawId::bump_3p}))
    caption += " Where the force jumps at an edge, energy grows with the square of the depth.";
  if (contains(laws, {LawId::bump_1p_shaded}))
    caption += " Under the shaded single polygon it is nearly in proportion to the depth.";
  caption += " It is a property of these laws, not an error: a controller in the device loop has to take it back.";
  if (!conservative.empty())
    caption += " The conservative laws (" + conservative + ") give none; the most that any of their loops gave or took is " +
               html_number(rest, 2) + "\u202FmJ.";
  if (!plot.all_positive)
    caption += " <strong>A loop that gave none, or took energy, has no place on a logarithmic axis and is not shown.</strong>";
  return figure(number, "two", "Energy per loop", "",
                {{"bound and measured", plot.energy_svg()}, {"difference", plot.difference_svg()}}, caption);
}

}  // namespace

std::string figures(const Certificate& certificate) {
  const std::vector<Drawn> laws = drawn(certificate);
  if (laws.empty()) return "";
  int number = 0;
  std::string html = force_figure(++number, laws);
  const auto bump = std::find_if(laws.begin(), laws.end(), [](const Drawn& drawn) { return drawn.shape.R > 0; });
  if (bump != laws.end()) html += surface_figure(++number, bump->parameters);
  html += error_figure(++number, laws);
  const EnergyPlot energy(laws);
  if (!energy.is_empty()) html += energy_figure(++number, laws, energy);
  return html;
}

}  // namespace forceshade::properties
