// SPDX-License-Identifier: BSD-3-Clause
// An analysis as text and as CSV.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "study/analysis/analysis.h"
#include "study/analysis/origins.h"
#include "study/tests/analysis/small_analysis.h"
#include "tests/support/has.h"

namespace forceshade::analysis {
namespace {

using forceshade::tests::has;

TEST(analysis_text, has_the_tables_in_the_thesiss_layout) {
  const std::string text = to_text(small_analysis());
  for (const char* part : {"Table 6.3: Flat, shaded, no vision\n  participant  trials  slope", "\n  overall      120     ",
                           "thesis       300     0.43", "Table 7.1: overall rows", "Table 6.9: answers, all participants",
                           "99 1 0 0", "θ-critical", "95 % BCa intervals (Efron 1987)"})
    EXPECT_TRUE(has(text, part)) << part << "\nin\n" << text;
  const std::string csv = to_csv(small_analysis());
  EXPECT_TRUE(
      csv.starts_with("table,stimulus,vision,radius_mil,participant,trials,column,value,low,high,thesis,answered_by\n6.3,bump-"
                      "1p-shaded,no,,P1,"));
  const std::string first = csv.substr(0, csv.find("\n6.3,bump-1p-shaded,no,,P1,60,mean_sd_percent,"));
  EXPECT_TRUE(first.ends_with(",,not recorded")) << first;  // the thesis's number stands beside overall rows alone
  EXPECT_TRUE(has(csv, ",0.43,not recorded\n6.3,bump-1p-shaded,no,,overall,120,mean_sd_percent,")) << csv;
  EXPECT_TRUE(has(csv, "\n6.9,bump-1p,,600,overall,48,percent_1,")) << csv;
  const auto lines = std::ranges::count(csv, '\n');
  EXPECT_EQ(lines, 1 + 2 * 3 * 4 + 3 * 21 * 4);
}

TEST(analysis_text, in_csv_has_both_ends_of_an_interval_and_nothing_for_what_is_not_defined) {
  Analysis analysis;
  MatchingRow row{"A", 9, {}, {}, {}};
  row.columns[0] = {0.5, {0.25, 0.75}};
  row.columns[2] = {7, {}};
  row.columns[3] = {5, {5, 5}};  // everybody gave the same answer
  analysis.matching.push_back({"own", true, {row}});
  const std::string csv = to_csv(analysis);
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,slope,0.5,0.25,0.75,,\n")) << csv;
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,mean_sd_percent,,,,,\n")) << csv;
  EXPECT_TRUE(has(csv, "\n,own,yes,,A,9,mean_satisfaction,7,,,,\n")) << csv;
  EXPECT_TRUE(has(csv, ",5,5,5,,\n")) << csv;
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
  analysis.psychometric.push_back(estimate_of_p1());
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

TEST(analysis_text, is_this_text_as_a_whole) {
  EXPECT_EQ(to_text(made_analysis()),
            "Table 6.2: Circular cylinder, with vision\n"
            "  participant  trials  slope                mean SD (%)         mean SI           mean steps\n"
            "  P1           9       0.91 (0.81 to 1.01)  10.3 (9.1 to 11.2)  7.7 (6.6 to 8.8)  20.4 (18.3 to 22.5)\n"
            "  overall      18      0.90 (0.80 to 0.96)  12.5                8.0 (7.0 to 9.0)  30.6 (28.5 to 32.7)\n"
            "  thesis       300     0.94                 12.9                8.3               29\n"
            "\n"
            "Table: own é, no vision\n"
            "  participant  trials  slope  mean SD (%)  mean SI  mean steps\n"
            "  overall      4       -      -            6.0      3.5\n"
            "\n"
            "Table 7.1: overall rows\n"
            "  bump                       trials  slope                mean SD (%)  mean SI           mean steps\n"
            "  Circular cylinder, vision  18      0.90 (0.80 to 0.96)  12.5         8.0 (7.0 to 9.0)  30.6 (28.5 to 32.7)\n"
            "  own é, no vision           4       -                    -            6.0               3.5\n"
            "\n"
            "Table 6.9: answers, all participants\n"
            "  bump               radius (mil)  trials  1 (%)       2 (%)         3 (%)          4 (%)  thesis\n"
            "  Circular cylinder  600           24      4 (1 to 9)  12 (5 to 20)  21 (11 to 32)  63     0 7 19 75\n"
            "  own                650.5         8       25          26            24             25     -\n"
            "\n"
            "Answer 4 against the angle that each polygon subtends\n"
            "  participant  θ-critical (°)       scale (°)         guess                lapse                deviance  p, "
            "bootstrap  p, chi-square  \n"
            "  P1           21.5 (18.5 to 24.5)  4.2 (3.2 to 5.8)  0.06 (0.01 to 0.11)  0.07 (0.02 to 0.13)  8.5       0.125   "
            "      0.375          \n"
            "  overall      31.5                 5.2               0.16                 0.17                 9.5       -       "
            "      0.625          at a limit of its range\n"
            "\n"
            "90 % BCa intervals (Efron 1987) of 123 resamples, seed 45; units: trials within participant and radius, so the "
            "intervals are about these participants; psychometric fits: maximum likelihood, 67 refits\n");
}

TEST(analysis_text, says_which_method_was_used) {
  AnalysisOptions options;
  options.resampling = {8, 9, 0.99, Unit::participants};
  EXPECT_EQ(method_of(options),
            "99 % BCa intervals (Efron 1987) of 9 resamples, seed 8; units in overall rows: participants, so those intervals "
            "are about people like them; psychometric fits: maximum likelihood, 1000 refits");
}

TEST(analysis_text, in_csv_is_this_text_as_a_whole) {
  Analysis analysis = made_analysis();
  analysis.matching[1].stimulus = "own, \"é\"";
  analysis.classification.resize(3);
  analysis.results.matching.resize(1);
  analysis.results.matching[0].participant = "P1";
  analysis.results.matching[0].origin = {experiments::AnsweredBy::person, "phantom", true};
  EXPECT_EQ(to_csv(analysis),
            "table,stimulus,vision,radius_mil,participant,trials,column,value,low,high,thesis,answered_by\n"
            "6.2,bump-cylinder,yes,,P1,9,slope,0.912,0.811,1.013,,person\n"
            "6.2,bump-cylinder,yes,,P1,9,mean_sd_percent,10.26,9.1,11.2,,person\n"
            "6.2,bump-cylinder,yes,,P1,9,mean_satisfaction,7.7,6.6,8.8,,person\n"
            "6.2,bump-cylinder,yes,,P1,9,mean_steps,20.4,18.3,22.5,,person\n"
            "6.2,bump-cylinder,yes,,overall,18,slope,0.9,0.8,0.96,0.94,person\n"
            "6.2,bump-cylinder,yes,,overall,18,mean_sd_percent,12.5,,,12.9,person\n"
            "6.2,bump-cylinder,yes,,overall,18,mean_satisfaction,8,7,9,8.3,person\n"
            "6.2,bump-cylinder,yes,,overall,18,mean_steps,30.6,28.5,32.7,29,person\n"
            ",\"own, \"\"é\"\"\",no,,overall,4,slope,,,,,person\n"
            ",\"own, \"\"é\"\"\",no,,overall,4,mean_sd_percent,,,,,person\n"
            ",\"own, \"\"é\"\"\",no,,overall,4,mean_satisfaction,6,,,,person\n"
            ",\"own, \"\"é\"\"\",no,,overall,4,mean_steps,3.5,,,,person\n"
            "6.9,bump-cylinder,,600,overall,24,percent_1,4,1,9,0,person\n"
            "6.9,bump-cylinder,,600,overall,24,percent_2,12,5,20,7,person\n"
            "6.9,bump-cylinder,,600,overall,24,percent_3,21,11,32,19,person\n"
            "6.9,bump-cylinder,,600,overall,24,percent_4,63,,,75,person\n"
            ",own,,650.5,overall,8,percent_1,25,,,,person\n"
            ",own,,650.5,overall,8,percent_2,26,,,,person\n"
            ",own,,650.5,overall,8,percent_3,24,,,,person\n"
            ",own,,650.5,overall,8,percent_4,25,,,,person\n"
            "6.9,bump-cylinder,,600,P1,12,percent_1,3,,,,person\n"
            "6.9,bump-cylinder,,600,P1,12,percent_2,13,,,,person\n"
            "6.9,bump-cylinder,,600,P1,12,percent_3,22,,,,person\n"
            "6.9,bump-cylinder,,600,P1,12,percent_4,62,,,,person\n");
}

experiments::Results results_from(const std::vector<std::pair<std::string, experiments::Origin>>& trials) {
  experiments::Results results;
  for (const auto& [participant, origin] : trials) {
    results.classification.emplace_back().participant = participant;
    results.classification.back().origin = origin;
  }
  return results;
}

// Every text made of results names who answered and with which device; a mixture is refused.
TEST(origins, are_said_in_whole_sentences) {
  const experiments::Origin model{experiments::AnsweredBy::model, "simulated:premium-1.5:mouse", false},
      person{experiments::AnsweredBy::person, "phantom", true}, unknown;
  const auto sentences = [](const experiments::Results& results) {
    std::string all;
    for (const std::string& one : sentences_of(origins_of(results))) all += one + '\n';
    return all;
  };
  EXPECT_EQ(sentences({}), "");
  EXPECT_EQ(
      sentences(results_from({{"V1", model}, {"V1", model}})),
      "These are virtual participants: a model answered, and no person.\nDevice: simulated:premium-1.5:mouse (2 trials).\n"
      "Forces: not certified in 2 trials.\n");
  EXPECT_EQ(sentences(results_from({{"P1", person}})), "Device: phantom (1 trial).\nForces: certified in 1 trial.\n");
  EXPECT_EQ(sentences(results_from({{"P1", unknown}})),
            "It was not recorded who answered, a person or a model.\nDevice: not recorded (1 trial).\n"
            "Forces: not known to be certified in 1 trial.\n");
  EXPECT_EQ(
      sentences(results_from({{"P1", person}, {"P2", unknown}, {"P3", {experiments::AnsweredBy::person, "mouse", false}}})),
      "It was not recorded who answered, a person or a model, for P2.\n"
      "Devices: not recorded (1 trial), mouse (1 trial), phantom (1 trial).\n"
      "Forces: certified in 1 trial, not certified in 1 trial, not known to be certified in 1 trial.\n");
  const auto fault = [](const experiments::Results& results) { return fault_of(origins_of(results)); };
  EXPECT_EQ(fault(results_from({{"V1", model}, {"V2", model}})), "");
  EXPECT_EQ(fault(results_from({{"P1", person}, {"P2", unknown}})), "");
  const std::string both = "expected people or virtual participants, got both: V1 is a virtual participant, a model, and P1 ";
  EXPECT_EQ(fault(results_from({{"P1", person}, {"V1", model}})), both + "is a person; analyse them separately");
  EXPECT_EQ(fault(results_from({{"P1", unknown}, {"V1", model}})), both + "is not recorded as one; analyse them separately");
  const Origins people = origins_of(results_from({{"P1", person}, {"P2", unknown}, {"P2", person}}));
  EXPECT_EQ(answered_by(people, "P1"), "person");
  EXPECT_EQ(answered_by(people, "P2"), "person and not recorded");
  EXPECT_EQ(answered_by(people, kOverall), "person and not recorded");
}

}  // namespace
}  // namespace forceshade::analysis
