// SPDX-License-Identifier: BSD-3-Clause
#include "report/conformance/figures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "report/conformance/error_map.h"
#include "report/conformance/error_size.h"
#include "report/gnuplot.h"
#include "report/html.h"
#include "report/plot_text.h"

namespace forceshade::conformance {
namespace {

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

}  // namespace forceshade::conformance
