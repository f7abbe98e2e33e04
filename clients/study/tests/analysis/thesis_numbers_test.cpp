// SPDX-License-Identifier: BSD-3-Clause
// The thesis's printed numbers, and what clients/study/analysis/thesis_numbers.md says of them.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "study/analysis/consistency.h"
#include "study/analysis/thesis.h"

namespace forceshade::analysis {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(std::string(FORCESHADE_SOURCE_DIR).append("/").append(path)).rdbuf();
  return text.str();
}

TEST(thesis_numbers, are_all_there) {
  ASSERT_EQ(thesis_matching().size(), 8U);
  for (const ThesisMatchingTable& table : thesis_matching()) {
    ASSERT_EQ(table.rows.size(), 6U) << table.number;
    std::string names;
    for (const ThesisRow& row : table.rows) names += row.participant + ' ';
    EXPECT_EQ(names, "TP IU AL IG KN overall ");
    for (const ThesisRow& row : table.rows) {
      EXPECT_TRUE(row.values[0] >= 0 && row.values[0] <= 1.1) << table.number;
      EXPECT_TRUE(row.values[1] > 1 && row.values[1] <= 20) << table.number;
      EXPECT_TRUE(row.values[2] >= 1 && row.values[2] <= 10) << table.number;
      EXPECT_TRUE(row.values[3] >= 15 && row.values[3] <= 72) << table.number;
    }
  }
  EXPECT_EQ(thesis_summary().size(), 8U);
  ASSERT_EQ(thesis_classification().size(), 21U);
  for (const ThesisClassificationRow& row : thesis_classification()) {
    int sum = 0;
    for (const int percent : row.percents) sum += percent;
    EXPECT_NEAR(sum, 100, 1) << row.stimulus << ' ' << row.radius;
  }
}

TEST(thesis_numbers, are_found_by_condition) {
  const ThesisMatchingTable* table = thesis_matching("bump-1p-shaded", true);
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->number, "6.4");
  EXPECT_EQ(table->overall().values, (std::array<double, 4>{0.57, 20, 7.5, 30}));
  EXPECT_EQ(thesis_matching("bump-1p", true), nullptr);
  const ThesisClassificationRow* row = thesis_classification("bump-2p", 1400);
  ASSERT_NE(row, nullptr);
  EXPECT_EQ(row->percents, (std::array<int, 4>{8, 47, 1, 44}));
  EXPECT_EQ(thesis_classification("bump-2p", 800), nullptr);
  EXPECT_EQ(title_of("bump-cylinder"), "Circular cylinder");
  EXPECT_EQ(title_of("bump-3p-shaded"), "Three polygons, shaded");
  EXPECT_EQ(title_of("bump-2p"), "Two polygons, unshaded");
  EXPECT_EQ(title_of("bump-2pp"), "bump-2pp");
  EXPECT_EQ(title_of("own"), "own");
}

// Slopes, satisfaction and steps are means of the participants' to rounding, but for one number; no SD is.
TEST(thesis_numbers, of_overall_rows_are_means_except_these) {
  std::string differing;
  for (const MeanCheck& check : mean_checks())
    if (!check.agrees) differing += check.table + ' ' + kMatchingColumns[check.column] + ", ";
  EXPECT_EQ(
      differing,
      "6.1 mean SD (%), 6.2 mean SD (%), 6.3 mean SD (%), 6.4 mean SD (%), 6.5 mean SD (%), 6.6 mean SD (%), 6.7 mean SD (%), "
      "6.7 mean SI, 6.8 mean SD (%), ");
}

TEST(thesis_numbers, of_overall_sds_can_be_of_pooled_radii) {
  for (const PooledCheck& check : pooled_checks()) {
    EXPECT_GT(check.overall, check.rms) << check.table;
    ASSERT_TRUE(check.between.has_value()) << check.table;
    EXPECT_LT(*check.between, 20) << check.table;
  }
}

TEST(thesis_numbers, of_table_7_1_are_the_overall_rows) {
  EXPECT_TRUE(differing_summary_rows().empty());
}

// By hand: with 2 answers, 50 50 0 0 is one way, 33 33 33 0 none; with 3 it is 1 + 1 + 1 in one way. 1 of 8 answers is 12.5 %,
// which can be printed as 12 or 13.
TEST(thesis_numbers, counts_are_found_for_percentages) {
  EXPECT_EQ(ways_to_count({50, 50, 0, 0}, 2), 1);
  EXPECT_EQ(ways_to_count({33, 33, 33, 0}, 2), 0);
  EXPECT_EQ(ways_to_count({33, 33, 33, 0}, 3), 1);
  EXPECT_EQ(ways_to_count({12, 88, 0, 0}, 8), 1);
  EXPECT_EQ(ways_to_count({13, 87, 0, 0}, 8), 1);
  EXPECT_EQ(ways_to_count({14, 86, 0, 0}, 8), 0);
}

TEST(thesis_numbers, of_four_rows_of_table_6_9_are_of_no_120_answers) {
  std::string impossible;
  for (const CountCheck& check : count_checks())
    if (check.ways == 0) impossible += check.stimulus + ' ' + std::to_string(check.radius) + ", ";
  EXPECT_EQ(impossible, "bump-2p 600, bump-3p 1000, bump-cylinder 600, bump-2p-shaded 600, ");
}

TEST(thesis_numbers, page_has_what_is_computed) {
  const std::string page = text_of("clients/study/analysis/thesis_numbers.md");
  std::size_t at = 0;
  for (const std::string& line : consistency_lines()) {
    const std::size_t found = page.find(line + '\n', at);
    EXPECT_NE(found, std::string::npos) << line;
    if (found != std::string::npos) at = found + line.size();
  }
}

// The files are what is compiled in: no character is lost on the way.
TEST(thesis_numbers, are_those_of_the_files) {
  const std::string file = text_of("clients/study/analysis/thesis/table_6_3.csv");
  std::string again = "participant,slope,mean_sd_percent,mean_satisfaction,mean_steps\n";
  for (const ThesisRow& row : thesis_matching("bump-1p-shaded", false)->rows) {
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "%s,%.2f,%.1f,%.1f,%.0f\n", row.participant.c_str(), row.values[0], row.values[1],
                  row.values[2], row.values[3]);
    again += line.data();
  }
  EXPECT_EQ(file, again);
}

}  // namespace
}  // namespace forceshade::analysis
