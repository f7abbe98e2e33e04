// SPDX-License-Identifier: BSD-3-Clause
#include "report/conformance/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "report/gnuplot.h"
#include "report/html.h"
#include "report/panels.h"
#include "report/plot_text.h"

namespace forceshade::conformance {
namespace {

// The colours by which pictures tell errors apart.
struct ErrorSize {
  std::uint64_t least;  // ulp, up to that of the next one
  const char* colour;   // each darker than the one before, so that no sight of colours is needed
  const char* words;
};

constexpr std::array<ErrorSize, 6> kErrorSizes{{{0, "#c6c1b4", "0"},
                                                {1, "#f0a830", "1"},
                                                {2, "#d55e00", "2 to 255"},
                                                {256, "#a31621", "256 to 65\u202F535"},
                                                {65536, "#541388", "65\u202F536 and more"},
                                                {kNoNumber, "#000000", "no finite force"}}};

const ErrorSize& size_of(std::uint64_t ulps) {
  std::size_t i = kErrorSizes.size() - 1;
  while (ulps < kErrorSizes[i].least) --i;
  return kErrorSizes[i];
}

using properties::figure;
using properties::grouped;
using properties::html_number;
using properties::Panel;
using properties::plotted;

struct Bar {
  std::string label;  // gnuplot's enhanced text
  std::uint64_t count;
  const char* colour;
};

// Bars over a logarithmic axis of counts, without those beyond the first and the last that counts something.
std::string bars_svg(std::vector<Bar> bars, const std::string& id, const std::string& description, const std::string& axis) {
  const auto is_empty = [](const Bar& bar) { return bar.count == 0; };
  bars.erase(std::ranges::find_if_not(bars.rbegin(), bars.rend(), is_empty).base(), bars.end());
  bars.erase(bars.begin(), std::ranges::find_if_not(bars, is_empty));
  std::string block, labels;
  const std::size_t every = 1 + bars.size() / 12;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    block += std::to_string(i) + ' ' + (is_empty(bars[i]) ? "NaN" : std::to_string(bars[i].count)) + " 0x" +
             std::string(bars[i].colour).substr(1) + '\n';
    if (i % every == 0 || i + 1 == bars.size())
      labels += (labels.empty() ? "" : ", ") + ("\"" + bars[i].label + "\" ") + std::to_string(i);
  }
  const double most = static_cast<double>(std::ranges::max(bars, {}, &Bar::count).count);
  return properties::svg_plot(
      {480, 270, id, description},
      "$bars << EOD\n" + block + "EOD\n" + properties::kPlain + properties::margins(0.12, 0.98, 0.88, 0.18) +
          "set logscale y\nset format y '10^{%T}'\nset style fill solid noborder\nset boxwidth 0.8\n" +
          properties::range("x", -0.8, static_cast<double>(bars.size()) - 0.2) + properties::range("y", 0.5, 2 * most) +
          "set xtics (" + labels + ") offset 0, 0.3\nset xlabel \"" + axis + "\" offset 0, 0.5 textcolor rgb '#333333'\n" +
          properties::vertical_name("answers") + "plot $bars using 1:2:3 with boxes lc rgb variable\n");
}

// 1, 2, 4, then powers of two.
std::string least_ulps(std::size_t bin) {
  if (bin == Judgement::kUlpBins - 1) return "none";
  if (bin < 8) return std::to_string(bin == 0 ? 0 : 1U << (bin - 1));
  return "2^{" + std::to_string(bin - 1) + '}';
}

std::string ulp_svg(const Judgement& found) {
  std::vector<Bar> bars;
  for (std::size_t bin = 0; bin < Judgement::kUlpBins; ++bin)
    bars.push_back({least_ulps(bin), found.by_ulps[bin],
                    size_of(bin == Judgement::kUlpBins - 1 ? kNoNumber
                            : bin == 0                     ? 0
                                                           : std::uint64_t{1} << (bin - 1))
                        .colour});
  return bars_svg(bars, "errors-ulp", "The numbers of answers by distance from the correctly rounded force",
                  "binary32 numbers (ulp) from the correctly rounded force, at least");
}

std::string newton_svg(const Judgement& found) {
  std::vector<Bar> bars{{"0", found.all.cases - found.all.wrong, kErrorSizes.front().colour}};
  for (std::size_t bin = 0; bin < found.by_newtons.size(); ++bin) {
    const int power = Judgement::kLeastPower + static_cast<int>(bin);
    const std::uint64_t right = bin == 0 ? found.all.cases - found.all.wrong : 0;
    bars.push_back({power > Judgement::kMostPower ? "more" : "10^{" + std::to_string(power) + '}',
                    found.by_newtons[bin] - right, "#4f6d8f"});
  }
  // The right ones stand beside the smallest error.
  const auto first = std::find_if(bars.begin() + 1, bars.end(), [](const Bar& bar) { return bar.count > 0; });
  bars.erase(bars.begin() + 1, first);
  return bars_svg(bars, "errors-newton", "The numbers of answers by distance from the exact force",
                  "distance from the exact force (N), at most");
}

std::string distribution(int number, const Judgement& found) {
  return figure(
      number, "two", "The sizes of the errors", "",
      {{"in binary32 numbers", ulp_svg(found)}, {"in newtons", newton_svg(found)}},
      "All " + grouped(found.all.cases) +
          " answers that were judged. The axis of counts is logarithmic, so that one answer among many is seen. At 0 "
          "are the correctly rounded ones. On the left is the component that is furthest off; “none” is an answer that "
          "is infinite or not a number, and on the right it stands under “more”.");
}

std::string map_figure(int number, const Judgement& found, const Description& subject) {
  const ErrorMap map = error_map(found, subject);
  std::string legend = "binary32 numbers from the correctly rounded force:";
  for (const ErrorSize& size : kErrorSizes) legend += ' ' + properties::legend_line(size.colour, size.words);
  const auto drawn = [](const Sample<Place>& sample) {
    const std::uint64_t kept = std::min<std::uint64_t>(sample.seen(), Sample<Place>::kMost);
    return (kept == sample.seen() ? "all " : grouped(kept) + " of ") + grouped(sample.seen());
  };
  std::string caption = "A position for each of " + drawn(found.wrong) + " wrong answers, and for " + drawn(found.right) +
                        " right ones; where not all are drawn, each had the same chance to be.";
  if (map.outside > 0)
    caption += ' ' + properties::plural(map.outside, "position") + (map.outside == 1 ? " of them lies" : " of them lie") +
               " outside the picture: positions are also taken far away, and at the ends of the domain.";
  return figure(number, "one", "The places of the errors", legend, {{map.plane, map.svg}}, caption + ' ' + map.what_is_drawn);
}

struct Plane {
  Eigen::Index up = 2;                            // the axis that is drawn upwards; x is drawn to the right
  double left = 0, right = 0, low = 0, high = 0;  // mm
  std::string lines;                              // x and the other coordinate, what lies beneath the positions
  const char* what_is_drawn = "";
  bool is_to_scale = false;
};

Plane plane_of(const DescribedLaw& its) {
  const properties::Drawn law(its.law, its.parameters);
  const auto [low, high] = heights(law);
  Plane plane{2, -law.reach(), law.reach(), low, high, "", "The line is the nominal surface.", false};
  for (const properties::Sample& sample : across(law)) {
    const auto x = static_cast<double>(sample.x);
    plane.lines += plotted(x) + ' ' + plotted(law.surface(x)) + '\n';
  }
  return plane;
}

// The edges of the mesh, and a fifth of its size around them.
Plane plane_of(const mesh::TriangleMesh& mesh) {
  constexpr std::size_t kMostEdges = 6000;
  Plane plane{1, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, "", "", true};
  for (const mesh::Vertex& vertex : mesh.vertices) {
    plane.left = std::min(plane.left, static_cast<double>(vertex[0]));
    plane.right = std::max(plane.right, static_cast<double>(vertex[0]));
    plane.low = std::min(plane.low, static_cast<double>(vertex[1]));
    plane.high = std::max(plane.high, static_cast<double>(vertex[1]));
  }
  const double room = std::max(0.1 * std::max(plane.right - plane.left, plane.high - plane.low), 1e-3);
  plane.left -= room, plane.right += room, plane.low -= room, plane.high += room;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(triangle[i], triangle[(i + 1) % 3]));
  if (edges.size() > kMostEdges) return plane;
  for (const auto& [a, b] : edges) {
    for (const std::uint32_t at : {a, b})
      plane.lines +=
          plotted(static_cast<double>(mesh.vertices[at][0])) + ' ' + plotted(static_cast<double>(mesh.vertices[at][1])) + '\n';
    plane.lines += '\n';
  }
  plane.what_is_drawn = "The lines are the edges of the mesh.";
  return plane;
}

// A height map has no end but that of the domain: what four fifths of the positions are in.
Plane plane_of(const std::vector<Place>& places) {
  Plane plane{1, -1, 1, -1, 1, "", "", false};
  for (const Eigen::Index axis : {0, 1}) {
    std::vector<double> all;
    for (const Place& place : places)
      if (std::isfinite(place.position[axis])) all.push_back(static_cast<double>(place.position[axis]));
    if (all.empty()) continue;
    std::ranges::sort(all);
    const double low = all[all.size() / 10], high = all[all.size() - 1 - all.size() / 10];
    const double room = std::max(0.05 * (high - low), 1e-3);
    (axis == 0 ? plane.left : plane.low) = low - room;
    (axis == 0 ? plane.right : plane.high) = high + room;
  }
  return plane;
}

Plane plane_of(const Description& subject, const std::vector<Place>& places) {
  return subject.visit([](const DescribedLaw& law) { return plane_of(law); },
                       [](const MeshRendering& rendering) { return plane_of(rendering.mesh()); },
                       [&](const auto&) { return plane_of(places); });
}

}  // namespace

std::string figures(const Judgement& found, const Description& subject, int first) {
  if (found.all.cases == 0) return "";
  int number = first;
  std::string html;
  if (found.all.wrong > 0) html += distribution(number++, found);
  return html + map_figure(number, found, subject);
}

std::string course_figure(int number, const std::vector<TimedForce>& course) {
  constexpr std::size_t kDrawn = 2000;
  const std::size_t step = (course.size() + kDrawn - 1) / kDrawn;
  std::string rows;
  for (std::size_t i = 0; i < course.size(); i += step)
    rows += plotted(course[i].time) + ' ' + plotted(course[i].exact) + ' ' + plotted(course[i].measured) + ' ' +
            plotted(course[i].measured - course[i].exact) + '\n';
  constexpr const char *kExact = "#4f6d8f", *kMeasured = "#a33c16";
  const auto panel = [&](const char* id, const char* description, const std::string& plots) {
    return properties::svg_plot({860, 220, id, description},
                                "$course << EOD\n" + rows + "EOD\n" + properties::kPlain +
                                    properties::margins(0.07, 0.99, 0.88, 0.25) +
                                    "set xlabel \"time (s)\" offset 0, 0.5 textcolor rgb '#333333'\n" +
                                    properties::vertical_name("N") + "plot " + plots + '\n');
  };
  const std::string line = " with lines lw 1.5 lc rgb '";
  return figure(
      number, "one", "The force over time",
      properties::legend_line(kExact, "the exact force") + ' ' + properties::legend_line(kMeasured, "the measured one"),
      {{"the sizes of both", panel("course", "The sizes of the measured and of the exact force over time",
                                   "$course using 1:2" + line + kExact + "', $course using 1:3" + line + kMeasured + "'")},
       {"the measured size less the exact one",
        panel("course-off", "The size of the measured force less that of the exact one, over time",
              "$course using 1:4" + line + kMeasured + "'")}},
      (step == 1 ? "All " : "One in " + grouped(step) + " of ") + properties::plural(course.size(), "sample") +
          ", after the fit where there is one: without the sensor’s offset and at the position of its lag.");
}

std::string deviations_figure(const std::vector<Invariant>& invariants) {
  constexpr double kLeast = 1e-6, kMost = 1e6;
  std::string points, names;
  int row = 0;
  for (const Invariant& each : invariants) {
    if (each.not_applicable || !each.share_of_allowed) continue;
    const std::string height = std::to_string(-row++);
    names += "set label " + properties::quoted(each.name) + " noenhanced at graph 0, first " + height +
             " front boxed offset 0, 0.65 textcolor rgb '#333333'\n";
    points += plotted(std::clamp(*each.share_of_allowed, kLeast, kMost)) + ' ' + height + ' ' +
              (each.violation ? "0xa31621" : "0x4f6d8f") + '\n';
  }
  if (row == 0) return "";
  const int height = 60 + 34 * row;
  const std::string svg = properties::svg_plot(
      {480, height, "deviations", "The largest deviation of each invariant over the allowed one"},
      "$points << EOD\n" + points + "EOD\n" + properties::kPlain + properties::margins(0.03, 0.97, 1, 50.0 / height) +
          "set style textbox opaque noborder margins 0.3, 0\nset border 1\nset logscale x\nset format x '10^{%T}'\nset xtics "
          "100\nunset ytics\n" +
          properties::range("x", kLeast / 2, 2 * kMost) + properties::range("y", 0.4 - row, 0.9) + names +
          "set xlabel \"largest deviation / allowed one\" offset 0, 0.6 textcolor rgb '#333333'\n"
          "set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb '#333333' dt 2\n"
          "plot for [i=0:" +
          std::to_string(row - 1) +
          "] -i with lines lc rgb '#dddddd', "
          "$points using 1:2:3 with points pt 7 ps 0.7 lc rgb variable\n");
  return figure(1, "one", "The used share of what is allowed", "", {{"each invariant that was measured", svg}},
                "The dashed line is what is allowed; violated invariants are red. Smaller shares than 10⁻⁶ are drawn "
                "there, and larger ones than 10⁶, or answers that are no numbers, at 10⁶.");
}

ErrorMap error_map(const Judgement& found, const Description& subject) {
  std::vector<Place> places = found.right.values();
  const std::vector<Place> wrong = found.wrong.values();
  places.insert(places.end(), wrong.begin(), wrong.end());
  const Plane plane = plane_of(subject, places);

  ErrorMap map{plane.up == 2 ? "from the side: <i>x</i> and <i>z</i>" : "from above: <i>x</i> and <i>y</i>", "",
               plane.what_is_drawn};
  std::array<std::string, kErrorSizes.size()> blocks;
  for (const Place& place : places) {
    const auto x = static_cast<double>(place.position.x()), up = static_cast<double>(place.position[plane.up]);
    if (x >= plane.left && x <= plane.right && up >= plane.low && up <= plane.high)
      blocks[static_cast<std::size_t>(&size_of(place.ulps) - kErrorSizes.data())] += plotted(x) + ' ' + plotted(up) + '\n';
    else
      ++map.outside;
  }

  // px
  constexpr int kWidth = 600, kBeside = 58, kAbove = 34, kBelow = 48;
  const double across = kWidth - 1.3 * kBeside;
  const double up =
      plane.is_to_scale ? std::clamp(across * (plane.high - plane.low) / (plane.right - plane.left), 160.0, 520.0) : 300;
  const int height = static_cast<int>(up) + kAbove + kBelow;
  std::string script = "$lines << EOD\n" + plane.lines + "EOD\n", plots;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].empty()) continue;
    const std::string name = "$errors" + std::to_string(i);
    script += name + " << EOD\n" + blocks[i] + "EOD\n";
    plots += (plots.empty() ? "" : ", ") + name + " with points pt 7 ps " + (i == 0 ? "0.22" : "0.45") + " lc rgb '" +
             kErrorSizes[i].colour + '\'';
  }
  if (!plane.lines.empty())
    plots = "$lines with lines lw " + std::string(plane.up == 2 ? "1.4 lc rgb '#222222'" : "0.6 lc rgb '#9aa7b3'") +
            (plots.empty() ? "" : ", ") + plots;
  else if (plots.empty())
    plots = "NaN";
  map.svg = properties::svg_plot(
      {kWidth, height, "error-map", "Positions of answers, coloured by how far they are from the correctly rounded force"},
      script + properties::kPlain +
          properties::margins(kBeside / double(kWidth), 1 - 0.3 * kBeside / double(kWidth), 1 - kAbove / double(height),
                              kBelow / double(height)) +
          properties::range("x", plane.left, plane.right) + properties::range("y", plane.low, plane.high) + properties::kXName +
          properties::vertical_name(plane.up == 2 ? "{/:Italic z} (mm)" : "{/:Italic y} (mm)") + "plot " + plots + '\n');
  return map;
}

}  // namespace forceshade::conformance
