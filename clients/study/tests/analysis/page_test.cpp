// SPDX-License-Identifier: BSD-3-Clause
// The page of an analysis and its figures.

#include "study/analysis/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "study/analysis/figures.h"
#include "study/analysis/thesis.h"
#include "study/tests/analysis/small_analysis.h"
#include "tests/support/has.h"

namespace forceshade::analysis {
namespace {

using forceshade::tests::has;

Profiles some_profiles() {
  return {
      {{"P1, trial 3", 1000, {{0, 600}, {2, 650}, {3.5, 700}}}, {"no change", 600, {{0, 600}}}, {"nothing", 600, {}}},
      {{"P1, trial 3", {{-5, -0.5}, {0, 2.9}, {5, 2}}, nominal_line(LawId::bump_cylinder, {25.4F, 25.4F, 0.5F}, 0, -30, 30)},
       {"empty", {}, {}}}};
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

// A page's words with | where a cell ends, a line for each row, heading and paragraph; * stands before a number that is marked.
std::string words_of(const std::string& page) {
  std::string words;
  const std::string body = page.substr(page.find("<body>"));
  for (std::size_t at = 0; at < body.size();) {
    if (body[at] != '<') {
      const std::size_t end = std::min(body.find('<', at), body.size());
      if (body.compare(at, end - at, "\n") != 0) words += body.substr(at, end - at);
      at = end;
      continue;
    }
    const std::size_t end = body.find('>', at) + 1;
    const std::string tag = body.substr(at, end - at);
    if (tag.starts_with("<tr class=")) words += tag.substr(11, tag.find('"', 11) - 11) + ": ";
    if (tag == "<small>") words += " / ";
    if (tag == "<span class=\"outside\">") words += "*";
    if (tag == "</th>" || tag == "</td>") words += '|';
    if (tag == "</tr>" || tag == "</p>" || tag == "</h1>" || tag == "</h2>" || tag == "</h3>") words += '\n';
    at = end;
  }
  return words;
}

TEST(page, has_these_words_in_its_tables) {
  Analysis analysis = made_analysis();
  analysis.matching[0].rows[0].participant = "P<1>";
  analysis.results.matching.resize(1234);
  analysis.results.classification.resize(5);
  std::string words = words_of(to_html(analysis, {}, {}));
  for (std::size_t at; (at = words.find("Below each number")) != std::string::npos ||
                       (at = words.find("Answers in percent of")) != std::string::npos ||
                       (at = words.find("How often a shaded bump")) != std::string::npos;)
    words.erase(at, words.find('\n', at) + 1 - at);
  EXPECT_EQ(
      words,
      "forceshade: analysis of the experiments\n"
      "1 participant, 1\u202F234 matching and 5 classification trials.\n"
      "It was not recorded who answered, a person or a model. Device: not recorded (1239 trials). Forces: not known to be "
      "certified in 1239 trials.\n" +
          method_of(analysis.options) +
          ".\n"
          "The matching experiment\n"
          "Table 6.2: Circular cylinder, with vision\n"
          "participant|trials|slope|mean SD (%)|mean SI|mean steps|\n"
          ": P&lt;1&gt;|9|0.91 / 0.81 to 1.01|10.3 / 9.1 to 11.2|7.7 / 6.6 to 8.8|20.4 / 18.3 to 22.5|\n"
          "overall: overall|18|0.90 / 0.80 to 0.96|12.5|8.0 / 7.0 to 9.0|30.6 / 28.5 to 32.7|\n"
          "thesis: thesis|300|0.94|12.9|8.3|29|\n"
          "Table: own é, no vision\n"
          "participant|trials|slope|mean SD (%)|mean SI|mean steps|\n"
          "overall: overall|4|-|-|6.0|3.5|\n"
          "Table 7.1: overall rows\n"
          "bump|trials|slope|mean SD (%)|mean SI|mean steps|\n"
          ": Circular cylinder, vision|18|0.90 / 0.80 to 0.96|12.5|8.0 / 7.0 to 9.0|30.6 / 28.5 to 32.7|\n"
          "thesis: thesis|300|0.94|12.9|8.3|29|\n"
          ": own é, no vision|4|-|-|6.0|3.5|\n"
          "The classification experiment\n"
          "Table 6.9: all participants\n"
          "bump|trials|1 (%)|2 (%)|3 (%)|4 (%)|\n"
          ": Circular cylinder, 600 mil|24|4 / 1 to 9|12 / 5 to 20|21 / 11 to 32|63|\n"
          "thesis: thesis|120|*0|7|19|75|\n"
          ": own, 650 mil|8|25|26|24|25|\n"
          "P1\n"
          "bump|trials|1 (%)|2 (%)|3 (%)|4 (%)|\n"
          ": Circular cylinder, 600 mil|12|3|13|22|62|\n"
          ": own, 650 mil|6|1|2|3|94|\n"
          "P2\n"
          "bump|trials|1 (%)|2 (%)|3 (%)|4 (%)|\n"
          ": own, 650 mil|2|5|6|7|82|\n"
          "θ-critical\n"
          "participant|trials|θ-critical (°)|scale (°)|guess|lapse|deviance|p, bootstrap|p, chi-square|\n"
          ": P1|7|21.5 / 18.5 to 24.5|4.2 / 3.2 to 5.8|0.06 / 0.01 to 0.11|0.07 / 0.02 to 0.13|8.5|0.125|0.375|\n"
          "overall: overall|71|31.5|5.2|0.16|0.17|9.5|-|0.625|\n"
          "overall: a parameter lies at a limit of its range, so the data do not determine all four.\n");
}

// In the heading, the first sentences and the name of each figure.
TEST(page, says_that_participants_were_virtual_and_forces_not_certified) {
  Analysis analysis = small_analysis();
  for (auto& trial : analysis.results.matching) trial.origin = {experiments::AnsweredBy::model, "simulated:<x>", false};
  for (auto& trial : analysis.results.classification) trial.origin = {experiments::AnsweredBy::model, "simulated:<x>", true};
  const std::vector<properties::Picture> all = pictures(analysis, some_profiles());
  const std::string words = words_of(to_html(analysis, all, {}));
  const std::string expected =
      "forceshade: analysis of the experiments with virtual participants\n2 virtual participants, 240 matching and 1\u202F008 "
      "classification trials.\nThese are virtual participants: a model answered, and no person. Device: simulated:&lt;x&gt; "
      "(1248 "
      "trials). Forces: certified in 1008 trials, not certified in 240 trials.\n";
  EXPECT_EQ(words.substr(0, expected.size()), expected);
  EXPECT_TRUE(has(to_text(analysis), "These are virtual participants: a model answered, and no person.\n"));
  for (const properties::Picture& one : all)
    EXPECT_TRUE(one.frame.description.ends_with(", virtual participants")) << one.frame.id;
  for (auto& trial : analysis.results.classification) trial.origin = {experiments::AnsweredBy::person, "phantom", true};
  for (auto& trial : analysis.results.matching) trial.origin = {experiments::AnsweredBy::person, "phantom", true};
  EXPECT_FALSE(has(to_html(analysis, all, {}).substr(0, 2000) + to_text(analysis), "virtual"));
}

TEST(page, leaves_out_what_was_not_measured) {
  Analysis analysis = made_analysis();
  const auto has_heading = [](const Analysis& of, const std::string& heading) {
    return has(to_html(of, {}, {}), "<h2>" + heading + "</h2>");
  };
  EXPECT_TRUE(has_heading(analysis, "θ-critical"));
  analysis.psychometric.clear();
  EXPECT_FALSE(has_heading(analysis, "θ-critical"));
  EXPECT_TRUE(has_heading(analysis, "The classification experiment"));
  analysis.classification.clear();
  EXPECT_FALSE(has_heading(analysis, "The classification experiment"));
  EXPECT_TRUE(has_heading(analysis, "The matching experiment"));
  EXPECT_FALSE(has(to_text(analysis), "Table 6.9"));
  EXPECT_FALSE(has(to_text(analysis), "Answer 4"));
  analysis.matching.clear();
  EXPECT_FALSE(has_heading(analysis, "The matching experiment"));
  EXPECT_EQ(to_text(analysis), method_of(analysis.options) + '\n');
}

// Every kind of figure has the caption of its kind, beneath the drawing that was made of it.
TEST(page, puts_each_caption_below_its_figure) {
  const Analysis analysis = small_analysis();
  const std::vector<properties::Picture> all = pictures(analysis, some_profiles());
  std::vector<std::string> drawn;
  for (std::size_t i = 0; i < all.size(); ++i) drawn.push_back("drawing " + std::to_string(i));
  const std::string page = to_html(analysis, all, drawn);
  const std::vector<std::string> captions{"Each mark is a trial",
                                          "The thesis's satisfaction index",
                                          "Each mark is a trial",
                                          "The thesis's satisfaction index",
                                          "Each point is a bump and a radius",
                                          "Each point is a change of the radius",
                                          "Dots are positions of the stylus",
                                          "Dots are positions of the stylus"};
  ASSERT_EQ(all.size(), captions.size());
  std::size_t at = 0;
  const auto next = [&](const std::string& words) {
    const std::size_t found = page.find(words, at);
    EXPECT_NE(found, std::string::npos) << words;
    if (found != std::string::npos) at = found + words.size();
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    next("<span>Figure " + std::to_string(i + 1) + "</span> ");
    next(drawn[i] + "</div>");
    next("<figcaption>" + captions[i]);
  }
}

}  // namespace
}  // namespace forceshade::analysis
