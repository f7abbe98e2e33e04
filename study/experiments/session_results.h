// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The answers of sessions, from their logs.

#include <filesystem>
#include <span>

#include "study/experiments/results.h"
#include "study/experiments/session_folder.h"

namespace forceshade::experiments {

// The results of every trial that was answered; practice, trials that an interruption ended and trials of a block that was
// repeated are left out. A session that is not over has the results it has.
Results results_of(const SavedSession& session);

// The results of the sessions in these folders together. Throws Error, also where a participant and trial of an experiment
// come twice.
Results results_of(std::span<const std::filesystem::path> folders);

}  // namespace forceshade::experiments
