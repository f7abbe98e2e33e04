// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/consistency.h"

#include <cmath>
#include <cstdlib>

#include "study/analysis/number_words.h"

namespace forceshade::analysis {
namespace {

constexpr std::array<double, 4> kUnits{0.01, 0.1, 0.1, 1};

// In units of the last printed digit.
long in_units(double printed, std::size_t column) {
  return std::lround(printed / kUnits[column]);
}

// True if `count` of `trials` answers can be printed as this percentage.
bool rounds_to(int count, int trials, int percent) {
  return std::abs(200 * count - 2 * percent * trials) <= trials;
}

double mean_of(const ThesisMatchingTable& table, std::size_t column) {
  double sum = 0;
  for (int i = 0; i < kThesisParticipants; ++i) sum += table.rows[static_cast<std::size_t>(i)].values[column];
  return sum / kThesisParticipants;
}

}  // namespace

std::vector<MeanCheck> mean_checks() {
  std::vector<MeanCheck> checks;
  for (const ThesisMatchingTable& table : thesis_matching())
    for (std::size_t column = 0; column < kMatchingColumns.size(); ++column) {
      long difference = -kThesisParticipants * in_units(table.overall().values[column], column);
      for (std::size_t i = 0; i < kThesisParticipants; ++i) difference += in_units(table.rows[i].values[column], column);
      checks.push_back({table.number, column, table.overall().values[column], mean_of(table, column),
                        std::labs(difference) <= kThesisParticipants});
    }
  return checks;
}

std::vector<PooledCheck> pooled_checks() {
  constexpr double kTrials = kThesisParticipants * kThesisTrialsPerRadius;
  std::vector<PooledCheck> checks;
  for (const ThesisMatchingTable& table : thesis_matching()) {
    double squares = 0;
    for (std::size_t i = 0; i < kThesisParticipants; ++i) squares += table.rows[i].values[1] * table.rows[i].values[1];
    const double overall = table.overall().values[1], rms = std::sqrt(squares / kThesisParticipants);
    const double between = ((kTrials - 1) * overall * overall - (kTrials - kThesisParticipants) * rms * rms) /
                           (kThesisTrialsPerRadius * (kThesisParticipants - 1));
    checks.push_back(
        {table.number, overall, mean_of(table, 1), rms, between >= 0 ? std::optional(std::sqrt(between)) : std::nullopt});
  }
  return checks;
}

std::vector<std::string> differing_summary_rows() {
  std::vector<std::string> differing;
  for (const ThesisSummaryRow& row : thesis_summary()) {
    const ThesisMatchingTable* table = thesis_matching(row.stimulus, row.vision);
    if (table == nullptr || table->overall().values != row.values)
      differing.push_back(row.stimulus + (row.vision ? ", vision" : ", no vision"));
  }
  return differing;
}

int ways_to_count(const std::array<int, 4>& percents, int trials) {
  int ways = 0;
  for (int first = 0; first <= trials; ++first) {
    if (!rounds_to(first, trials, percents[0])) continue;
    for (int second = 0; first + second <= trials; ++second) {
      if (!rounds_to(second, trials, percents[1])) continue;
      for (int third = 0; first + second + third <= trials; ++third)
        ways += rounds_to(third, trials, percents[2]) && rounds_to(trials - first - second - third, trials, percents[3]);
    }
  }
  return ways;
}

std::vector<CountCheck> count_checks() {
  std::vector<CountCheck> checks;
  for (const ThesisClassificationRow& row : thesis_classification()) {
    CountCheck check{row.stimulus, row.radius, 0, ways_to_count(row.percents, kThesisTrialsPerRow)};
    for (const int percent : row.percents) check.sum += percent;
    for (int away = 1; check.ways == 0 && away <= 10; ++away) {
      if (check.fewer == 0 && ways_to_count(row.percents, kThesisTrialsPerRow - away) > 0)
        check.fewer = kThesisTrialsPerRow - away;
      if (check.more == 0 && ways_to_count(row.percents, kThesisTrialsPerRow + away) > 0)
        check.more = kThesisTrialsPerRow + away;
    }
    checks.push_back(check);
  }
  return checks;
}

std::vector<std::string> consistency_lines() {
  std::vector<std::string> lines{"| table | column | overall, printed | mean of the participants | to rounding |",
                                 "|---|---|---|---|---|"};
  for (const MeanCheck& check : mean_checks())
    lines.push_back("| " + check.table + " | " + kMatchingColumns[check.column] + " | " +
                    fixed(check.overall, kMatchingDecimals[check.column]) + " | " +
                    fixed(check.mean, kMatchingDecimals[check.column] + 1) + " | " + (check.agrees ? "equal" : "**differs**") +
                    " |");
  lines.emplace_back(
      "| table | overall SD, printed (%) | mean of the participants (%) | root mean square (%) | between participants (%) |");
  lines.emplace_back("|---|---|---|---|---|");
  for (const PooledCheck& check : pooled_checks())
    lines.push_back("| " + check.table + " | " + fixed(check.overall, 1) + " | " + fixed(check.mean, 1) + " | " +
                    fixed(check.rms, 1) + " | " + (check.between ? fixed(*check.between, 1) : "none") + " |");
  lines.emplace_back("| bump | radius (mil) | sum of the percentages | ways to count 120 answers | trials that fit |");
  lines.emplace_back("|---|---|---|---|---|");
  for (const CountCheck& check : count_checks()) {
    const std::string fewer = check.fewer == 0 ? "none from 110" : std::to_string(check.fewer);
    const std::string more = check.more == 0 ? "none to 130" : std::to_string(check.more);
    lines.push_back("| " + check.stimulus + " | " + std::to_string(check.radius) + " | " + std::to_string(check.sum) + " | " +
                    (check.ways == 0 ? "**none**" : std::to_string(check.ways)) + " | " +
                    (check.ways > 0 ? "120" : fewer + ", " + more) + " |");
  }
  return lines;
}

}  // namespace forceshade::analysis
