// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "study/analysis/figures.h"
#include "study/analysis/thesis.h"
#include "tests/analysis/simulated.h"

namespace forceshade::analysis {
namespace {

Analysis small_analysis() {
  experiments::Results results;
  Random random(1, "page");
  for (const char* name : {"P1", "<P2> & 'co'"}) {
    tests::add_matching(results.matching, random, {60, 0.85, 0.13, 7.7, 1.3, 3.2, 0.4}, name, "bump-1p-shaded", false);
    tests::add_matching(results.matching, random, {60, 0.85, 0.13, 7.7, 1.3, 3.2, 0.4}, name, "own <bump>'", true);
    tests::add_classification(results.classification, random, {58, 9, 0.2, 0.08}, name);
  }
  AnalysisOptions options;
  options.resampling.count = 100;
  options.psychometric_count = 10;
  return analyze(std::move(results), options);
}

Profiles some_profiles() {
  return {
      {{"P1, trial 3", 1000, {{0, 600}, {2, 650}, {3.5, 700}}}, {"no change", 600, {{0, 600}}}, {"nothing", 600, {}}},
      {{"P1, trial 3", {{-5, -0.5}, {0, 2.9}, {5, 2}}, nominal_line(LawId::bump_cylinder, {25.4F, 25.4F, 0.5F}, 0, -30, 30)},
       {"empty", {}, {}}}};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(page, draws_every_figure_of_chapter_6) {
  const Analysis analysis = small_analysis();
  const std::vector<properties::Picture> all = pictures(analysis, some_profiles());
  std::string ids;
  std::vector<std::string> drawn;
  for (const properties::Picture& picture : all) {
    ids += picture.frame.id + ' ';
    drawn.push_back(properties::svg_plot(picture));
    EXPECT_TRUE(drawn.back().starts_with("<svg") && has(drawn.back(), "<path")) << picture.frame.id;
  }
  EXPECT_EQ(ids,
            "matching-bump-1p-shaded-no-vision satisfaction-bump-1p-shaded-no-vision matching-own__bump__-vision "
            "satisfaction-own__bump__-vision psychometric radius-profiles position-profile-1 position-profile-2 ");
  EXPECT_TRUE(properties::png_file(all[0]).starts_with("\x89PNG"));
  const std::string page = to_html(analysis, all, drawn);
  for (const char* part :
       {"Table 6.3: Flat, shaded, no vision", "Table: own &lt;bump&gt;&#39;, with vision", "Table 7.1", "Table 6.9",
        "Final against reference radius: Flat, shaded, no vision", "Satisfaction against reference radius: own &lt;bump&gt;",
        "θ-critical", "BCa", "seed 1", "<span>Figure 8</span>", "&lt;P2&gt; &amp; &#39;co&#39;"})
    EXPECT_TRUE(has(page, part)) << part;
  // Nothing is loaded from elsewhere, and no name becomes an element.
  for (const char* part : {"<script", " src=", "@import", "url(http", "<P2>", "<bump>", "<link"})
    EXPECT_FALSE(has(page, part)) << part;
}

// In a participant's panel and in that of all, each by the mark of the radius that it began with.
TEST(page, draws_every_trial_once_in_each_of_its_panels) {
  const Analysis analysis = small_analysis();
  const MatchingTable& table = analysis.matching.front();
  const std::string commands = scatter(analysis.results, table).commands;
  std::istringstream lines(commands);
  std::size_t trials = 0;
  bool is_data = false;
  for (std::string line; std::getline(lines, line);) {
    if (is_data && line != "EOD" && line != "NaN NaN") ++trials;
    if (line == "EOD") is_data = false;
    if (line.ends_with("<< EOD")) is_data = true;
  }
  EXPECT_EQ(trials, 2 * table.overall().trials);
}

// To rounding: 6.5 of the thesis is 6.45 to 6.55.
TEST(page, marks_a_number_of_the_thesis_outside_the_interval_alone) {
  const double printed = thesis_matching("bump-cylinder", false)->overall().values[0];
  Analysis analysis;
  MatchingTable table{"bump-cylinder", false, {MatchingRow{kOverall, 300, {}, {}, {}}}};
  const auto is_marked = [&](double low, double high) {
    table.rows[0].columns[0] = {printed, {low, high}};
    analysis.matching = {table};
    const std::string page = to_html(analysis, {}, {});
    const std::string body = page.substr(page.find("</tr></thead>"));
    return has(body, "<span class=\"outside\">");
  };
  EXPECT_FALSE(is_marked(printed - 0.1, printed + 0.1));
  EXPECT_FALSE(is_marked(printed + 0.003, printed + 0.1)) << "it may have been as large before it was rounded";
  EXPECT_FALSE(is_marked(printed - 0.1, printed - 0.003));
  EXPECT_TRUE(is_marked(printed + 0.006, printed + 0.1));
  EXPECT_TRUE(is_marked(printed - 0.1, printed - 0.006));
}

TEST(page, is_made_without_pictures_where_gnuplot_is_missing) {
  const Analysis analysis = small_analysis();
  const std::string page = to_html(analysis, pictures(analysis, {}), {});
  EXPECT_FALSE(has(page, "<svg"));
  EXPECT_TRUE(has(page, "Table 6.9"));
}

// The cylinder of radius 25.4 mm on a chord of 25.4 mm is 25.4 (1 - sqrt(3)/2) = 3.40296 mm high; two polygons are as high, and
// half as high at a quarter of the width; one polygon is the plane.
TEST(nominal_line, has_the_heights_of_the_bumps) {
  const Parameters parameters{25.4F, 25.4F, 0.5F};
  const auto height = [&](LawId law, double x) {
    for (const Position& at : nominal_line(law, parameters, 10, -10, 30))
      if (std::fabs(at.x - x) < 1e-9) return at.z;
    ADD_FAILURE() << "no place at " << x;
    return kUndefined;
  };
  EXPECT_NEAR(height(LawId::bump_cylinder, 10), 3.40296, 1e-5);
  EXPECT_NEAR(height(LawId::bump_cylinder, -10), 0, 1e-9);
  EXPECT_NEAR(height(LawId::bump_2p_shaded, 10), 3.40296, 1e-5);
  EXPECT_NEAR(height(LawId::bump_1p_shaded, 10), 0, 1e-9);
  const std::vector<Position> line = nominal_line(LawId::bump_3p, parameters, 10, -10, 30);
  EXPECT_TRUE(std::ranges::is_sorted(line, {}, &Position::x));
  EXPECT_TRUE(nominal_line(LawId::bump_3p, {-1, 25.4F, 0.5F}, 0, -1, 1).empty());
}

TEST(analysis_text, has_the_tables_in_the_thesiss_layout) {
  const std::string text = to_text(small_analysis());
  for (const char* part : {"Table 6.3: Flat, shaded, no vision\n  participant  trials  slope", "\n  overall      120     ",
                           "thesis       300     0.43", "Table 7.1: overall rows", "Table 6.9: answers, all participants",
                           "99 1 0 0", "θ-critical", "95 % BCa intervals (Efron 1987)"})
    EXPECT_TRUE(has(text, part)) << part << "\nin\n" << text;
  const std::string csv = to_csv(small_analysis());
  EXPECT_TRUE(csv.starts_with(
      "table,stimulus,vision,radius_mil,participant,trials,column,value,low,high,thesis\n6.3,bump-1p-shaded,no,,P1,"));
  const std::string first = csv.substr(0, csv.find("\n6.3,bump-1p-shaded,no,,P1,60,mean_sd_percent,"));
  EXPECT_TRUE(first.ends_with(",")) << first;  // the thesis's number stands beside overall rows alone
  EXPECT_TRUE(has(csv, ",0.43\n6.3,bump-1p-shaded,no,,overall,120,mean_sd_percent,")) << csv;
  EXPECT_TRUE(has(csv, "\n6.9,bump-1p,,600,overall,48,percent_1,")) << csv;
  const auto lines = std::ranges::count(csv, '\n');
  EXPECT_EQ(lines, 1 + 2 * 3 * 4 + 3 * 21 * 4);
}

TEST(analysis_text, in_csv_has_both_ends_of_an_interval_and_nothing_for_what_is_not_defined) {
  Analysis analysis;
  MatchingRow row{"A", 9, {}, {}, {}};
  row.columns[0] = {0.5, {0.25, 0.75}};
  row.columns[2] = {7, {}};
  analysis.matching.push_back({"own", true, {row}});
  const std::string csv = to_csv(analysis);
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,slope,0.5,0.25,0.75,\n")) << csv;
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,mean_sd_percent,,,,\n")) << csv;
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,mean_satisfaction,7,,,\n")) << csv;
}

// Tables and fits have numbers of resamples of their own: p of n refits is a multiple of 1 / (1 + n).
TEST(analysis_text, is_of_as_many_refits_as_it_says) {
  const Analysis analysis = small_analysis();
  ASSERT_FALSE(analysis.psychometric.empty());
  for (const PsychometricEstimate& one : analysis.psychometric)
    EXPECT_NEAR(one.p_bootstrap * 11, std::round(one.p_bootstrap * 11), 1e-9) << one.participant;
  EXPECT_TRUE(has(to_text(analysis), "of 100 resamples"));
  EXPECT_TRUE(has(to_text(analysis), "10 refits"));
}

// Every number of a psychometric fit another one, so that none can be in another's column.
TEST(analysis_text, has_each_number_of_a_psychometric_fit_in_its_column) {
  Analysis analysis;
  analysis.psychometric.push_back({.participant = "P1",
                                   .points = {},
                                   .fit = {{21.5, 4.25, 0.06, 0.07}, -100, 8.5, false},
                                   .threshold = {18.5, 24.5},
                                   .scale = {3.25, 5.75},
                                   .guess = {0.01, 0.11},
                                   .lapse = {0.02, 0.13},
                                   .p_bootstrap = 0.125,
                                   .p_chi_square = 0.375});
  std::string text = to_text(analysis);
  const auto without_runs_of_spaces = [](const std::string& words) {
    std::string all;
    for (const char c : words)
      if (c != ' ' || all.empty() || all.back() != ' ') all += c;
    return all;
  };
  text = without_runs_of_spaces(text);
  EXPECT_TRUE(has(text, "deviance p, bootstrap p, chi-square")) << text;
  EXPECT_TRUE(has(text, "P1 21.5 (18.5 to 24.5) 4.2 (3.2 to 5.8) 0.06 (0.01 to 0.11) 0.07 (0.02 to 0.13) 8.5 0.125 0.375"))
      << text;
}

}  // namespace
}  // namespace forceshade::analysis
