// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The ticks of a session, out of the parts in which they were recorded.

#include <filesystem>
#include <optional>
#include <vector>

#include "study/experiments/bids.h"

namespace forceshade::apparatus {

// The recordings of a run's folder, in the order of the run.
std::vector<std::filesystem::path> parts_of(const std::filesystem::path& run);

// For experiments::export_bids(): nothing where the run has no ticks. A run that was cut off has those that were recorded.
// Times are those of the trial log: this machine's clock, or the device's where the run was not paced. Reads a part at a time.
std::optional<experiments::Motion> motion_of(const std::filesystem::path& session, int run);

}  // namespace forceshade::apparatus
