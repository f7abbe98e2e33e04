// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "files/csv.h"
#include "study/analysis/distributions.h"
#include "study/analysis/random.h"
#include "study/analysis/thesis.h"

namespace forceshade::analysis {
namespace {

using experiments::ClassificationResult;
using experiments::MatchingResult;

template <class Result>
void add_participants(std::vector<std::string>& names, const std::vector<Result>& results) {
  for (const Result& result : results)
    if (std::ranges::find(names, result.participant) == names.end()) names.push_back(result.participant);
}

// A place in the thesis's order, then the name.
template <class Rows>
std::size_t place_of(const Rows& rows, const std::string& stimulus) {
  const auto found = std::ranges::find_if(rows, [&](const auto& row) { return row.stimulus == stimulus; });
  return static_cast<std::size_t>(found - rows.begin());
}

// Rows with equal keys in one stratum, each a unit of its own; or each participant's rows one unit of the only stratum.
template <class Result, class Key>
std::vector<Stratum> strata_of(const std::vector<Result>& results, const std::vector<std::size_t>& rows, Unit unit, Key key) {
  std::map<decltype(key(results[0])), Stratum> by_key;
  std::map<std::string, std::vector<std::size_t>> by_participant;
  for (const std::size_t row : rows) {
    by_key[key(results[row])].push_back({row});
    by_participant[results[row].participant].push_back(row);
  }
  std::vector<Stratum> strata;
  if (unit == Unit::trials)
    for (auto& [ignored, stratum] : by_key) strata.push_back(std::move(stratum));
  else {
    strata.emplace_back();
    for (auto& [ignored, all] : by_participant) strata.back().push_back(std::move(all));
  }
  return strata;
}

std::vector<double> columns_of(const MatchingSummary& summary) {
  return {summary.line.slope, summary.sd_percent, summary.satisfaction, summary.steps};
}

// One participant's own row is always about that participant: its trials are the units.
Unit unit_for(const std::string& participant, const Resampling& resampling) {
  return participant == kOverall ? resampling.unit : Unit::trials;
}

MatchingRow matching_row(const std::vector<MatchingResult>& trials, const std::vector<std::size_t>& rows,
                         const std::string& participant, Resampling resampling, std::string purpose) {
  resampling.unit = unit_for(participant, resampling);
  const auto strata = strata_of(trials, rows, resampling.unit, [](const MatchingResult& trial) {
    return std::pair(trial.participant, trial.reference_radius);
  });
  const std::vector<TrialNumbers> numbers = numbers_of(trials);
  const auto columns = [&](const std::vector<std::size_t>& some) { return columns_of(summary_of(numbers, some)); };
  std::vector<Interval> intervals;
  purpose += '/' + participant;
  if (resampling.unit == Unit::trials) {
    std::vector<std::size_t> people;
    for (const Stratum& stratum : strata) people.push_back(hash_of(trials[stratum.front().front()].participant));
    const ResidualWorld world = residual_world(numbers, strata, people);
    const auto of_world = [&](const std::vector<std::size_t>& some) { return columns_of(summary_of(world.trials, some)); };
    intervals.resize(columns_of({}).size());
    if (world.is_determined)
      intervals = bca_intervals(strata, columns, World{world.strata, world.draws, of_world}, resampling, purpose);
  } else {
    intervals = bca_intervals(strata, columns, resampling, purpose);
  }
  const MatchingSummary summary = summary_of(numbers, rows);
  const std::vector<double> values = columns_of(summary);
  MatchingRow row{participant, rows.size(), {}, summary.line, spreads_of(numbers, rows)};
  for (std::size_t k = 0; k < values.size(); ++k) row.columns[k] = {values[k], intervals[k]};
  return row;
}

// The exact interval of a proportion, in %; it has a closed form where the proportion is 0 or 1.
Interval exact_percent(std::size_t chosen, std::size_t trials, double level) {
  const double tail = 100 * std::pow((1 - level) / 2, 1 / static_cast<double>(trials));
  if (chosen == 0) return {0, 100 - tail};
  if (chosen == trials) return {tail, 100};
  const auto some = static_cast<double>(chosen), others = static_cast<double>(trials - chosen);
  return {100 * beta_quantile((1 - level) / 2, some, others + 1), 100 * beta_quantile((1 + level) / 2, some + 1, others)};
}

ClassificationRow classification_row(const std::vector<ClassificationResult>& trials, const std::vector<std::size_t>& rows,
                                     const std::string& participant, Resampling resampling) {
  const ClassificationResult& first = trials[rows.front()];
  ClassificationRow row{participant, first.stimulus, first.radius, rows.size(), {}};
  resampling.unit = unit_for(participant, resampling);
  const auto strata =
      strata_of(trials, rows, resampling.unit, [](const ClassificationResult& trial) { return trial.participant; });
  const auto percents = [&](const std::vector<std::size_t>& some) {
    std::vector<double> result(4);
    for (const std::size_t i : some) ++result[static_cast<std::size_t>(trials[i].answer - 1)];
    for (double& count : result) count = 100 * count / static_cast<double>(some.size());
    return result;
  };
  const std::vector<double> values = percents(rows);
  const bool is_of_one_person = resampling.unit == Unit::participants && strata.front().size() < 2;
  const std::vector<Interval> intervals = bca_intervals(
      strata, percents, resampling, "classification/" + row.stimulus + '/' + shortest(row.radius) + '/' + participant);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto chosen = static_cast<std::size_t>(
        std::ranges::count_if(rows, [&](std::size_t i) { return trials[i].answer == static_cast<int>(k) + 1; }));
    const bool is_same = !(intervals[k].low < intervals[k].high);  // in every resample
    const bool is_exact = is_same && !is_of_one_person && (resampling.count > 0 || chosen % rows.size() == 0);
    row.percents[k] = {values[k], is_exact ? exact_percent(chosen, rows.size(), resampling.level) : intervals[k]};
  }
  return row;
}

}  // namespace

std::vector<std::string> participants_of(const experiments::Results& results) {
  std::vector<std::string> names;
  add_participants(names, results.matching);
  add_participants(names, results.classification);
  return names;
}

std::vector<MatchingTable> matching_tables(const experiments::Results& results, const Resampling& resampling) {
  const std::vector<MatchingResult>& trials = results.matching;
  std::map<std::tuple<std::size_t, std::string, bool>, std::vector<std::size_t>> conditions;
  for (std::size_t row = 0; row < trials.size(); ++row)
    conditions[{place_of(thesis_matching(), trials[row].stimulus), trials[row].stimulus, trials[row].vision}].push_back(row);
  std::vector<MatchingTable> tables;
  for (const auto& [condition, rows] : conditions) {
    MatchingTable table{std::get<1>(condition), std::get<2>(condition), {}};
    const std::string purpose = "matching/" + table.stimulus + (table.vision ? "/vision" : "/no-vision");
    for (const std::string& participant : participants_of(results)) {
      std::vector<std::size_t> own;
      std::ranges::copy_if(rows, std::back_inserter(own),
                           [&](std::size_t row) { return trials[row].participant == participant; });
      if (!own.empty()) table.rows.push_back(matching_row(trials, own, participant, resampling, purpose));
    }
    table.rows.push_back(matching_row(trials, rows, kOverall, resampling, purpose));
    tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<ClassificationRow> classification_rows(const experiments::Results& results, const Resampling& resampling) {
  const std::vector<ClassificationResult>& trials = results.classification;
  std::map<std::tuple<std::size_t, std::string, double>, std::vector<std::size_t>> conditions;
  for (std::size_t row = 0; row < trials.size(); ++row)
    conditions[{place_of(thesis_classification(), trials[row].stimulus), trials[row].stimulus, trials[row].radius}].push_back(
        row);
  std::vector<ClassificationRow> table;
  for (const auto& [condition, rows] : conditions) table.push_back(classification_row(trials, rows, kOverall, resampling));
  for (const std::string& participant : participants_of(results))
    for (const auto& [condition, rows] : conditions) {
      std::vector<std::size_t> own;
      std::ranges::copy_if(rows, std::back_inserter(own),
                           [&](std::size_t row) { return trials[row].participant == participant; });
      if (!own.empty()) table.push_back(classification_row(trials, own, participant, resampling));
    }
  return table;
}

}  // namespace forceshade::analysis
