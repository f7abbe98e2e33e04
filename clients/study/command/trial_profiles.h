// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The course of single trials, for the figures of forceshade-study analyze (thesis 5.5.3): radius and position.

#include <filesystem>
#include <string>
#include <vector>

#include "study/analysis/page.h"
#include "study/experiments/results.h"

namespace forceshade::apps {

// The profiles of the trials "PARTICIPANT:NUMBER": the radii of each matching trial from `results`, and the positions of each
// trial that is in one of the folders with its ticks, over the nominal surfaces of the laws that were felt last. Throws
// Error where a trial is written otherwise, or has neither.
analysis::Profiles profiles_of(const std::vector<std::string>& trials, const std::vector<std::filesystem::path>& folders,
                               const experiments::Results& results);

}  // namespace forceshade::apps
