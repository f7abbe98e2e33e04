// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that the thesis's printed numbers fit each other, by whole-number arithmetic on the printed digits.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "study/analysis/thesis.h"

namespace forceshade::analysis {

// One column of one of tables 6.1 to 6.8. Printed numbers are within half a unit of their last digit, so the overall number is
// the mean of the five participants' where |sum - 5 * overall| <= 5 units.
struct MeanCheck {
  std::string table;
  std::size_t column;  // of kMatchingColumns
  double overall;      // as printed
  double mean;         // of the participants' printed numbers
  bool agrees;
};
std::vector<MeanCheck> mean_checks();

// Explains an overall SD above the mean of the participants': it is of the pooled radii of all of them, so it holds the
// differences between participants, too. In percent of a common mean m, with 12 trials for each of 5 participants,
// 59 * pooled^2 = 55 * rms^2 + 12 * 4 * between^2, where between is the standard deviation of the participants' mean radii.
struct PooledCheck {
  std::string table;
  double overall, mean, rms;
  std::optional<double> between;  // %; none where the overall SD is too small to be a pooled one
};
std::vector<PooledCheck> pooled_checks();

// Table 7.1 against the overall rows of tables 6.1 to 6.8: the rows that differ. Empty in the thesis.
std::vector<std::string> differing_summary_rows();

// One row of table 6.9: in how many ways 120 answers can be counted so that all four percentages round to the printed ones,
// halves to either side. Without such a way, the largest number of trials below 120 and the smallest above that fit.
struct CountCheck {
  std::string stimulus;
  int radius, sum;  // mil, %
  int ways;
  int fewer = 0, more = 0;  // trials; 0 where 120 fit, or nothing from 110 to 130
};
std::vector<CountCheck> count_checks();

// The number of ways in which `trials` answers can be counted so that their percentages round to these.
int ways_to_count(const std::array<int, 4>& percents, int trials);

// The tables of clients/study/analysis/thesis_numbers.md in Markdown, in the order of the functions above.
std::vector<std::string> consistency_lines();

}  // namespace forceshade::analysis
