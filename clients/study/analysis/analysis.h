// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All that is computed of a set of results, and as text.

#include <string>
#include <vector>

#include "study/analysis/psychometric.h"
#include "study/analysis/tables.h"

namespace forceshade::analysis {

struct AnalysisOptions {
  Resampling resampling;
  std::size_t psychometric_count = 1000;  // refits for each psychometric function
  double width = 1000;                    // of the bumps, mil
  PsychometricModel model;
};

struct Analysis {
  experiments::Results results;
  AnalysisOptions options;
  std::vector<MatchingTable> matching;
  std::vector<ClassificationRow> classification;
  std::vector<PsychometricEstimate> psychometric;  // of each participant, then kOverall; those that can be fitted
};

Analysis analyze(experiments::Results results, const AnalysisOptions& options);

// "Circular cylinder, no vision"
std::string condition_words(const MatchingTable& table);

// "Table 6.1: Circular cylinder, no vision", without a number for a condition that the thesis does not have.
std::string heading_of(const MatchingTable& table);

// The method of the intervals: level, method, unit, count, seed.
std::string method_of(const AnalysisOptions& options);

// Tables 6.1 to 6.9 and 7.1 with intervals, beside the thesis's overall rows; psychometric fits; who answered; the method.
std::string to_text(const Analysis& analysis);

// The same numbers as CSV, one row for each of them: table, stimulus, vision, radius, participant, trials, column, value,
// interval, the thesis's overall number, and who answered.
std::string to_csv(const Analysis& analysis);

}  // namespace forceshade::analysis
