// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tables 6.1 to 6.9 of the thesis for any results, per participant and overall, with intervals.

#include <array>
#include <string>
#include <vector>

#include "study/analysis/bootstrap.h"
#include "study/analysis/statistics.h"
#include "study/experiments/results.h"

namespace forceshade::analysis {

inline constexpr const char* kOverall = "overall";

// The four columns of kMatchingColumns.
struct MatchingRow {
  std::string participant;  // or kOverall
  std::size_t trials;
  std::array<Estimate, 4> columns;
  Line line;
  std::vector<Spread> spreads;
};

// The results of one matching bump, with or without vision.
struct MatchingTable {
  std::string stimulus;
  bool vision;
  std::vector<MatchingRow> rows;  // participants in the order of the results; the last row is kOverall, of all trials pooled

  const MatchingRow& overall() const { return rows.back(); }
};

// The answers for one bump and radius: one row of table 6.9.
struct ClassificationRow {
  std::string participant;  // or kOverall
  std::string stimulus;
  double radius;  // mil
  std::size_t trials;
  std::array<Estimate, 4> percents;  // of the answers 1 to 4
};

// The tables in the order of the thesis; conditions that it does not have come after them, by name.
std::vector<MatchingTable> matching_tables(const experiments::Results& results, const Resampling& resampling);

// The rows of table 6.9, overall, then those of each participant. Where each participant gives an answer always or never, so
// does every resample: then the interval is the exact one of Clopper and Pearson (1934) for all trials together. It is right
// for independent trials of one probability; where participants differ it is too long (Hoeffding 1956), never too short.
std::vector<ClassificationRow> classification_rows(const experiments::Results& results, const Resampling& resampling);

// The participants of the results, in the order in which they first appear.
std::vector<std::string> participants_of(const experiments::Results& results);

}  // namespace forceshade::analysis
