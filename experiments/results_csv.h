// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The results of sessions as two tidy CSV files, matching.csv and classification.csv, one row a trial.

#include <filesystem>

#include "forceshade/experiments/results.h"

namespace forceshade::experiments {

// vision is yes or no; initial is large, same or small; radii are in mil, seconds in s.
inline constexpr const char* kMatchingFile = "matching.csv";
inline constexpr const char* kClassificationFile = "classification.csv";

// Writes both files, each whole or not at all, replacing files of these names. Numbers read back as the same binary64 numbers.
// Throws csv::OutputError.
void write_results(const Results& results, const std::filesystem::path& folder);

// Reads both files, or the one that is there. Columns may be in any order, with others beside them. Throws csv::Error, which
// names file, line, column, value and what was expected: where neither file is there, a field is not of its range, or a
// participant has two rows of the same trial.
Results read_results(const std::filesystem::path& folder);

}  // namespace forceshade::experiments
