// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The answers of sessions, from their logs.

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "study/experiments/results.h"
#include "study/experiments/session_folder.h"

namespace forceshade::experiments {

// The use of the trial that an event belongs to. abandoned: it was answered, and its block was begun again.
enum class TrialUse { no_trial, interrupted, abandoned, practice, result };

// The use of the trial of each event of the session, in their order.
std::vector<TrialUse> uses_of(const SavedSession& session);

// The origin of the answers of a run.
Origin origin_of(const SavedSession& session, int run);

// The results of every trial that was answered; practice, trials that an interruption ended and trials of a block that was
// repeated are left out. A session that is not over has the results it has.
Results results_of(const SavedSession& session);

// The results of several folders together.
class GatheredResults {
 public:
  Results all;

  // Adds those of one more folder. Throws Error where a participant and trial of an experiment come twice.
  void add(const Results& more, const std::filesystem::path& folder);

 private:
  std::set<std::tuple<std::string, int, bool>> seen_;  // participant, trial, and whether it is one of matching
};

// The results of the sessions in these folders together. Throws Error, also where a participant and trial of an
// experiment come twice, or two participants differ in capital letters alone.
Results results_of(std::span<const std::filesystem::path> folders);

}  // namespace forceshade::experiments
