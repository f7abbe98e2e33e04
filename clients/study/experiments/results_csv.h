// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results as CSV files, one row a trial.

#include <filesystem>

#include "files/output_folder.h"
#include "study/experiments/results.h"

namespace forceshade::experiments {

// Writes matching.csv, classification.csv and radius.csv into the folder, which is made where it is missing: all of them or
// none. An experiment without trials has no file. clients/study/README.md lists the columns. Throws files::OutputError.
void write_results(const Results& results, const std::filesystem::path& folder);

// The same into a folder that the caller commits.
void write_results(const Results& results, const files::OutputFolder& folder);

// Reads those of the files that exist. Throws Error with file, line and column: numbers out of their
// range, a trial that is there twice, no file at all.
Results read_results(const std::filesystem::path& folder);

}  // namespace forceshade::experiments
