// SPDX-License-Identifier: BSD-3-Clause
// Percentages of answers where participants gave unlike numbers of them, and intervals where all gave the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

// Where everybody gave the same answer, the interval is that answer, and there is one.
TEST(interval, of_no_width_is_defined) {
  EXPECT_TRUE((Interval{5, 5}).is_defined());
  EXPECT_TRUE((Interval{5, 6}).is_defined());
  EXPECT_FALSE((Interval{6, 5}).is_defined());
  EXPECT_FALSE(Interval{}.is_defined());
  EXPECT_TRUE((Interval{5, 5}).contains(5));
}

}  // namespace
}  // namespace forceshade::analysis
