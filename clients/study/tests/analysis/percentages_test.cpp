// SPDX-License-Identifier: BSD-3-Clause
// Percentages of answers where participants gave unlike numbers of them, and intervals of single trials and where all gave the
// same.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "study/analysis/number_words.h"
#include "study/analysis/tables.h"

namespace forceshade::analysis {
namespace {

// A resample of two people is of both, of the one who always said 1, or of the one who always said 2.
TEST(percentages, of_a_resample_are_divided_by_its_own_number_of_answers) {
  experiments::Results results;
  for (int i = 0; i < 2; ++i) results.classification.push_back({"A", i + 1, "bump-2p-shaded", 600, i + 1, 1, 9});
  for (int i = 0; i < 6; ++i) results.classification.push_back({"B", i + 1, "bump-2p-shaded", 600, i + 1, 2, 9});
  const std::vector<ClassificationRow> rows = classification_rows(results, {1, 500, 0.95, Unit::participants});
  const auto overall = std::ranges::find(rows, kOverall, &ClassificationRow::participant);
  ASSERT_NE(overall, rows.end());
  ASSERT_EQ(overall->trials, 8U);
  EXPECT_NEAR(overall->percents[0].value, 25, 1e-12);
  EXPECT_NEAR(overall->percents[0].interval.low, 0, 1e-12);
  EXPECT_NEAR(overall->percents[0].interval.high, 100, 1e-12);
  EXPECT_NEAR(overall->percents[1].interval.high, 100, 1e-12);
}

// A always said 1 and B always 2, so every resample of trials is the same. Clopper and Pearson for 12 of 24: 29.12 to 70.88 %,
// for 1 of 1: 2.5 to 100 %. People as units show how far A and B differ, and one of them alone shows nothing of others.
TEST(percentages, have_the_exact_interval_where_every_resample_is_the_same) {
  experiments::Results results;
  for (int i = 0; i < 12; ++i) {
    results.classification.push_back({"A", i + 1, "bump-2p-shaded", 600, i + 1, 1, 9});
    results.classification.push_back({"B", i + 1, "bump-2p-shaded", 600, i + 1, 2, 9});
  }
  const auto words = [&](std::size_t trials, Unit unit) {
    experiments::Results some = results;
    some.classification.resize(trials);
    const Interval interval = classification_rows(some, {1, 500, 0.95, unit})[0].percents[0].interval;
    return fixed(interval, 2);
  };
  EXPECT_EQ(words(24, Unit::trials), "29.12 to 70.88");
  EXPECT_EQ(words(2, Unit::trials), "1.26 to 98.74");
  EXPECT_EQ(words(1, Unit::trials), "2.50 to 100.00");
  EXPECT_EQ(words(24, Unit::participants), "0.00 to 100.00");
  EXPECT_EQ(words(1, Unit::participants), "-");
}

// A participant's only trial at every radius has no deviation to draw. Where another radius has more trials it deviates as
// these do, so the interval is longer than that of a trial without any error, and not of length 0.
TEST(statistics, of_single_trials_have_an_interval_only_where_others_show_their_deviation) {
  const auto row_of = [](const std::vector<std::pair<std::string, double>>& trials, Unit unit = Unit::trials) {
    experiments::Results results;
    for (std::size_t i = 0; i < trials.size(); ++i)
      results.matching.push_back({trials[i].first,
                                  static_cast<int>(i) + 1,
                                  true,
                                  "bump-cylinder",
                                  {},
                                  1,
                                  trials[i].second,
                                  600,
                                  trials[i].second + 10.0 * static_cast<double>(i % 3),
                                  static_cast<int>(i % 5) + 1,
                                  static_cast<int>(i),
                                  9});
    return matching_tables(results, {1, 500, 0.95, unit})[0].overall();
  };
  const auto defined = [](const MatchingRow& row) {
    std::string all;
    for (const Estimate& column : row.columns) all += column.interval.is_defined() ? '1' : '0';
    return all;
  };
  EXPECT_EQ(defined(row_of({{"A", 600}, {"A", 800}, {"A", 1000}})), "0000");
  EXPECT_EQ(defined(row_of({{"A", 600}, {"A", 600}, {"A", 600}, {"B", 600}})), "0000") << "B's one trial shows nothing of B";
  const MatchingRow both = row_of({{"A", 600}, {"A", 600}, {"A", 600}, {"A", 800}});
  EXPECT_EQ(defined(both), "1011");
  // Freedom 2 of {600, 610, 620} and no own deviation of 800: the slope is (800 - mean) / 200, of which both ends have an
  // error.
  const double error_of_cell = 10 / std::sqrt(3.0) / 200, error_of_one = 800 * (10 / 610.0) / 200;
  EXPECT_GT(both.columns[0].interval.high - both.columns[0].interval.low, 2 * error_of_one);
  EXPECT_GT(error_of_one, 2 * error_of_cell);
  // One person is no sample of people.
  EXPECT_EQ(defined(row_of({{"A", 600}, {"A", 600}, {"A", 800}, {"A", 800}}, Unit::participants)), "0000");
  EXPECT_EQ(defined(row_of({{"A", 600}, {"A", 600}, {"A", 800}, {"A", 800}})), "1011")
      << "one of two has no standard deviation";
}

// An interval of answers that are all equal has no width, and is defined.
TEST(interval, of_no_width_is_defined) {
  EXPECT_TRUE((Interval{5, 5}).is_defined());
  EXPECT_TRUE((Interval{5, 6}).is_defined());
  EXPECT_FALSE((Interval{6, 5}).is_defined());
  EXPECT_FALSE(Interval{}.is_defined());
  EXPECT_TRUE((Interval{5, 5}).contains(5));
}

}  // namespace
}  // namespace forceshade::analysis
