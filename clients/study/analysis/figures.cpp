// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "report/plot_text.h"
#include "study/analysis/analysis.h"
#include "study/analysis/number_words.h"
#include "study/analysis/thesis.h"

namespace forceshade::analysis {
namespace {

using experiments::InitialRadius;
using experiments::MatchingResult;
using properties::Picture;
using properties::plotted;
using properties::quoted;

constexpr int kColumns = 3, kPanelWidth = 320, kPanelHeight = 280, kLegendHeight = 34;
constexpr int kWideTitle = 400;  // of a panel whose title names participant, bump, vision and trial

struct Mark {
  InitialRadius initial;
  const char *colour, *words;
  int point;
};
constexpr std::array<Mark, 3> kMarks{{{InitialRadius::small, "#0072b2", "began small", 6},
                                      {InitialRadius::same, "#444444", "began the same", 2},
                                      {InitialRadius::large, "#d55e00", "began large", 1}}};

struct Bounds {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // With a margin on both sides, of one where all values are the same; -1 to 1 of no values.
  Bounds wider(double share) const {
    if (low > high) return {-1, 1};
    const double margin = high > low ? share * (high - low) : 1;
    return {low - margin, high + margin};
  }
};

// Panels in rows of three at most; each is a title and commands.
Picture panels(const std::string& id, const std::string& description,
               const std::vector<std::pair<std::string, std::string>>& all, const std::string& common,
               int height = kPanelHeight, int width = kPanelWidth) {
  const int columns = std::clamp(static_cast<int>(all.size()), 1, kColumns);
  const int rows = std::max((static_cast<int>(all.size()) + columns - 1) / columns, 1);
  const double full_width = columns * width, full_height = rows * height + kLegendHeight;
  std::string commands = std::string(properties::kPlain) + "set multiplot\n" + common;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const double left = column * width, top = kLegendHeight + row * height;
    commands += properties::margins((left + 64) / full_width, (left + width - 12) / full_width, 1 - (top + 34) / full_height,
                                    1 - (top + height - 52) / full_height) +
                "set title " + quoted(all[i].first) + " noenhanced font ',11' offset 0, -0.4\n" + (i > 0 ? "unset key\n" : "") +
                all[i].second;
  }
  commands += "unset multiplot\n";
  return {{static_cast<int>(full_width), static_cast<int>(full_height), id, description}, commands};
}

// The legend of the first panel, above all of them.
constexpr const char* kLegend =
    "set key at screen 0.02, screen 1 left top vertical maxrows 1 Left reverse samplen 1.2 width 1 font ',10'\n";

std::string axes(const std::string& across, const std::string& up) {
  return "set xlabel " + quoted(across) + " offset 0, 0.5 font ',10' textcolor rgb '#333333'\nset ylabel " + quoted(up) +
         " offset 2, 0 font ',10' textcolor rgb '#333333'\nset xtics offset 0, 0.3 font ',9'\nset ytics offset 0.5, 0 font "
         "',9'\n";
}

std::string at_radii(const std::vector<Spread>& spreads) {
  std::string list;
  for (const Spread& spread : spreads) list += (list.empty() ? "" : ", ") + plotted(spread.reference);
  return "set xtics (" + list + ")\n";
}

bool is_of(const MatchingResult& trial, const MatchingTable& table, const MatchingRow& row) {
  const bool is_in_table = trial.stimulus == table.stimulus && trial.vision == table.vision;
  return is_in_table && (&row == &table.rows.back() || trial.participant == row.participant);
}

Bounds radii_of(const MatchingTable& table) {
  Bounds bounds;
  for (const Spread& spread : table.overall().spreads) bounds.add(spread.reference);
  return bounds.wider(0.1);
}

}  // namespace

std::string condition_name(const std::string& stimulus, bool vision) {
  std::string name = stimulus;
  for (char& c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (!is_plain) c = '_';
  }
  return name + (vision ? "-vision" : "-no-vision");
}

Picture scatter(const experiments::Results& results, const MatchingTable& table) {
  const Bounds across = radii_of(table);
  Bounds up;
  for (const MatchingResult& trial : results.matching)
    if (is_of(trial, table, table.overall())) up.add(trial.final_radius);
  up.add(across.low);
  up.add(across.high);
  up = up.wider(0.04);
  up.high += 0.09 * (up.high - up.low);  // for the percentages
  const double beside = (across.high - across.low) / 55;
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const MatchingRow& row = table.rows[i];
    std::string commands, plots;
    for (std::size_t m = 0; m < kMarks.size(); ++m) {
      const std::string block = "$trials" + std::to_string(i) + '_' + std::to_string(m);
      commands += block + " << EOD\n";
      bool is_empty = true;
      for (const MatchingResult& trial : results.matching) {
        if (!is_of(trial, table, row) || trial.initial != kMarks[m].initial) continue;
        is_empty = false;
        commands +=
            plotted(trial.reference_radius + (static_cast<double>(m) - 1) * beside) + ' ' + plotted(trial.final_radius) + '\n';
      }
      commands += is_empty ? "NaN NaN\nEOD\n" : "EOD\n";
      plots += ", " + block + " using 1:2 with points pt " + std::to_string(kMarks[m].point) + " ps 0.5 lw 1 lc rgb '" +
               kMarks[m].colour + "' title '" + kMarks[m].words + "'";
    }
    commands += "unset label\n";
    for (std::size_t k = 0; k < row.spreads.size(); ++k)
      commands += "set label " + std::to_string(k + 1) + " '" + fixed(row.spreads[k].sd_percent, 1) + " %' at first " +
                  plotted(row.spreads[k].reference) + ", graph 0.965 center font ',8' textcolor rgb '#333333'\n";
    commands += at_radii(row.spreads);
    std::string line = "NaN";
    if (std::isfinite(row.line.slope)) line = plotted(row.line.intercept) + " + " + plotted(row.line.slope) + "*x";
    commands += "plot x with lines lw 1 dt (4,4) lc rgb '#999999' title 'equal radii'" + plots + ", " + line +
                " with lines lw 1.8 lc rgb '#111111' title 'least squares'\n";
    all.emplace_back(row.participant + ": slope " + fixed(row.columns[0].value, 2) +
                         (row.columns[0].interval.is_defined() ? " (" + fixed(row.columns[0].interval, 2) + ')' : ""),
                     commands);
  }
  return panels("matching-" + condition_name(table.stimulus, table.vision),
                "Final against reference radius: " + condition_words(table), all,
                kLegend + axes("reference radius (mil)", "final radius (mil)") +
                    properties::range("x", across.low, across.high) + properties::range("y", up.low, up.high));
}

Picture satisfaction(const experiments::Results& results, const MatchingTable& table) {
  const Bounds across = radii_of(table);
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const MatchingRow& row = table.rows[i];
    std::map<std::pair<double, int>, int> counts;
    std::map<double, std::pair<double, int>> sums;
    int most = 1;
    for (const MatchingResult& trial : results.matching) {
      if (!is_of(trial, table, row)) continue;
      most = std::max(most, ++counts[{trial.reference_radius, trial.satisfaction}]);
      sums[trial.reference_radius].first += trial.satisfaction;
      ++sums[trial.reference_radius].second;
    }
    const std::string place = std::to_string(i);
    std::string commands = "$answers" + place + " << EOD\n";
    for (const auto& [where, count] : counts)
      commands += plotted(where.first) + ' ' + std::to_string(where.second) + ' ' +
                  plotted(2.2 * std::sqrt(static_cast<double>(count) / most)) + '\n';
    commands += "EOD\n$means" + place + " << EOD\n";
    for (const auto& [radius, sum] : sums) commands += plotted(radius) + ' ' + plotted(sum.first / sum.second) + '\n';
    commands += "EOD\n" + at_radii(row.spreads) + "plot $answers" + place +
                " using 1:2:3 with points pt 7 ps variable lc rgb '#9ecae1' title 'answers: the area is their number', $means" +
                place + " using 1:2 with linespoints pt 5 ps 0.6 lw 1.6 lc rgb '#111111' title 'mean'\n";
    all.emplace_back(row.participant + ": mean " + fixed(row.columns[2].value, 1), commands);
  }
  return panels("satisfaction-" + condition_name(table.stimulus, table.vision),
                "Satisfaction against reference radius: " + condition_words(table), all,
                kLegend + axes("reference radius (mil)", "satisfaction index") +
                    properties::range("x", across.low, across.high) + "set yrange [0.3:10.7]\nset ytics 1, 1, 10\n");
}

Picture psychometric_figure(const std::vector<PsychometricEstimate>& estimates, const PsychometricModel& model) {
  Bounds across;
  for (const PsychometricEstimate& one : estimates)
    for (const AngleCount& point : one.points) across.add(point.angle);
  across = across.wider(0.04);
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const PsychometricEstimate& one = estimates[i];
    const std::string place = std::to_string(i);
    std::string commands = "$answers" + place + " << EOD\n";
    for (const AngleCount& point : one.points)
      commands += plotted(point.angle) + ' ' + plotted(100.0 * point.chosen / point.trials) + '\n';
    commands += "EOD\n$curve" + place + " << EOD\n";
    for (int step = 0; step <= 200; ++step) {
      const double angle = across.low + (across.high - across.low) * step / 200;
      commands += plotted(angle) + ' ' + plotted(100 * probability_at(angle, one.fit.parameters, model.shape)) + '\n';
    }
    const auto within = [&](double angle) { return plotted(std::clamp(angle, across.low, across.high)); };
    commands += "EOD\nunset object\nunset arrow\n";
    if (one.threshold.is_defined())
      commands += "set object 1 rectangle from " + within(one.threshold.low) + ", graph 0 to " + within(one.threshold.high) +
                  ", graph 1 behind fillcolor rgb '#dbe7f2' fillstyle solid noborder\n";
    commands += "set arrow 1 from " + within(one.fit.parameters.threshold) + ", graph 0 to " +
                within(one.fit.parameters.threshold) + ", graph 1 nohead lw 1.2 dt (4,4) lc rgb '#0072b2'\nplot $curve" +
                place + " using 1:2 with lines lw 1.8 lc rgb '#111111' title 'fit', $answers" + place +
                " using 1:2 with points pt 7 ps 0.7 lc rgb '#d55e00' title 'answer 4', NaN with lines lw 1.2 dt (4,4) lc rgb "
                "'#0072b2' title "
                "'θ-critical, its interval shaded'\n";
    all.emplace_back(one.participant + ": " + fixed(one.fit.parameters.threshold, 1) + "° (" + fixed(one.threshold, 1) + ')',
                     commands);
  }
  return panels("psychometric", "Answer 4 against the angle of each polygon", all,
                kLegend + axes("angle that each polygon subtends (°)", "answer 4 (%)") +
                    properties::range("x", across.low, across.high) + "set yrange [-3:103]\nset ytics 20\n");
}

Picture radius_profiles(const std::vector<RadiusProfile>& profiles) {
  Bounds up;
  std::size_t most = 1;
  for (const RadiusProfile& profile : profiles) {
    up.add(profile.reference);
    most = std::max(most, profile.changes.size());
    for (const RadiusChange& change : profile.changes) up.add(change.radius);
  }
  up = up.wider(0.06);
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const std::string place = std::to_string(i);
    std::string commands = "$changes" + place + " << EOD\n";
    for (std::size_t step = 0; step < profiles[i].changes.size(); ++step)
      commands += std::to_string(step) + ' ' + plotted(profiles[i].changes[step].radius) + '\n';
    commands += (profiles[i].changes.empty() ? "NaN NaN\nEOD\nplot " : "EOD\nplot ") + plotted(profiles[i].reference) +
                " with lines lw 1 dt (4,4) lc rgb '#999999' title 'reference radius', $changes" + place +
                " using 1:2 with linespoints pt 7 ps 0.35 lw 1.2 lc rgb '#0072b2' title 'matching radius'\n";
    all.emplace_back(profiles[i].title, commands);
  }
  return panels("radius-profiles", "The matching radius, step by step", all,
                kLegend + axes("step", "radius (mil)") + properties::range("x", 0, static_cast<double>(most)) +
                    properties::range("y", up.low, up.high),
                kPanelHeight, kWideTitle);
}

Picture position_profile(const PositionProfile& profile) {
  Bounds across, up;
  std::string points, surface;
  for (const Position& at : profile.positions) {
    across.add(at.x);
    up.add(at.z);
    points += plotted(at.x) + ' ' + plotted(at.z) + '\n';
  }
  for (const Position& at : profile.nominal) {
    across.add(at.x);
    up.add(at.z);
    surface += plotted(at.x) + ' ' + plotted(at.z) + '\n';
  }
  across = across.wider(0.02);
  up = up.wider(0.15);
  // As long up as across: the height follows from the width.
  constexpr double kWidth = 900, kLeft = 60, kRight = 16, kTop = 60, kBottom = 50;
  const double per_mm = (kWidth - kLeft - kRight) / (across.high - across.low);
  const double height = std::clamp(kTop + kBottom + per_mm * (up.high - up.low), 170.0, 900.0);
  const std::string commands =
      std::string(properties::kPlain) + "$positions << EOD\n" + (points.empty() ? "NaN NaN\n" : points) +
      "EOD\n$surface << EOD\n" + (surface.empty() ? "NaN NaN\n" : surface) + "EOD\n" +
      properties::margins(kLeft / kWidth, 1 - kRight / kWidth, 1 - kTop / height, kBottom / height) + "set title " +
      quoted(profile.title) + " noenhanced font ',11'\n" +
      "set key at screen 0.98, screen 0.99 right top vertical maxrows 1 Left reverse samplen 1.2 font ',10'\n" +
      axes("x (mm)", "z (mm)") + properties::range("x", across.low, across.high) + properties::range("y", up.low, up.high) +
      properties::ticks("y", up.high - up.low, std::clamp(static_cast<int>(per_mm * (up.high - up.low) / 14), 2, 8)) +
      "plot $surface with lines lw 1.6 lc rgb '#111111' title 'nominal geometry', $positions with points pt 7 ps 0.22 lc rgb "
      "'#0072b2' "
      "title 'stylus'\n";
  return {{static_cast<int>(kWidth), static_cast<int>(height), "position-profile", "The stylus over the nominal geometry"},
          commands};
}

}  // namespace forceshade::analysis
