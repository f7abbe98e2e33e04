// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A small analysis, and one that is made up: every number of it another one.

#include <string>
#include <utility>

#include "study/analysis/analysis.h"
#include "study/tests/analysis/simulated.h"

namespace forceshade::analysis {

// A fit of which every number is another one.
inline PsychometricEstimate estimate_of_p1() {
  return {.participant = "P1",
          .points = {{0, 1, 3}, {10, 2, 4}},
          .fit = {{21.5, 4.25, 0.06, 0.07}, -100, 8.5, false},
          .threshold = {18.5, 24.5},
          .scale = {3.25, 5.75},
          .guess = {0.01, 0.11},
          .lapse = {0.02, 0.13},
          .p_bootstrap = 0.125,
          .p_chi_square = 0.375};
}

inline Analysis small_analysis() {
  experiments::Results results;
  Random random(1, "page");
  for (const char* name : {"P1", "<P2> & 'co'"}) {
    tests::add_matching(results.matching, random, {60, 0.85, 0.13, 7.7, 1.3, 3.2, 0.4}, name, "bump-1p-shaded", false);
    tests::add_matching(results.matching, random, {60, 0.85, 0.13, 7.7, 1.3, 3.2, 0.4}, name, "own <bump>'", true);
    tests::add_classification(results.classification, random, {58, 9, 0.2, 0.08}, name);
  }
  AnalysisOptions options;
  options.resampling.count = 100;
  options.psychometric_count = 10;
  return analyze(std::move(results), options);
}

// Every number another one. Some have no interval, some conditions are not the thesis's, one fit is at a limit.
inline Analysis made_analysis() {
  Analysis analysis;
  analysis.options.resampling = {45, 123, 0.9, Unit::trials};
  analysis.options.psychometric_count = 67;
  const MatchingRow p{
      "P1", 9, {{{0.912, {0.811, 1.013}}, {10.26, {9.1, 11.2}}, {7.7, {6.6, 8.8}}, {20.4, {18.3, 22.5}}}}, {}, {}};
  const MatchingRow all{kOverall, 18, {{{0.9, {0.8, 0.96}}, {12.5, {}}, {8, {7, 9}}, {30.6, {28.5, 32.7}}}}, {}, {}};
  const MatchingRow own{kOverall, 4, {{{}, {}, {6, {}}, {3.5, {}}}}, {}, {}};
  analysis.matching = {{"bump-cylinder", true, {p, all}}, {"own é", false, {own}}};
  analysis.classification = {{kOverall, "bump-cylinder", 600, 24, {{{4, {1, 9}}, {12, {5, 20}}, {21, {11, 32}}, {63, {}}}}},
                             {kOverall, "own", 650.5, 8, {{{25, {}}, {26, {}}, {24, {}}, {25, {}}}}},
                             {"P1", "bump-cylinder", 600, 12, {{{3, {}}, {13, {}}, {22, {}}, {62, {}}}}},
                             {"P1", "own", 650.5, 6, {{{1, {}}, {2, {}}, {3, {}}, {94, {}}}}},
                             {"P2", "own", 650.5, 2, {{{5, {}}, {6, {}}, {7, {}}, {82, {}}}}}};
  analysis.psychometric = {estimate_of_p1(),
                           {.participant = kOverall,
                            .points = {{0, 1, 30}, {10, 2, 41}},
                            .fit = {{31.5, 5.25, 0.16, 0.17}, -100, 9.5, true},
                            .threshold = {},
                            .scale = {},
                            .guess = {},
                            .lapse = {},
                            .p_bootstrap = kUndefined,
                            .p_chi_square = 0.625}};
  return analysis;
}

}  // namespace forceshade::analysis
