// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The events of a session as rows of BIDS files.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/experiments/session_results.h"

namespace forceshade::experiments {

inline constexpr const char* kMissing = "n/a";

// One row of an events file; what is empty becomes n/a.
struct EventRow {
  double onset = 0;
  std::optional<double> duration;
  std::string type;
  std::string trial, stimulus, radius, initial, initial_radius, repetition, vision, matching_radius, response, used;
};

// The names of the columns, and what follows them in a file.
std::string header_of_events();
std::string line_of(const EventRow& row);

// Those of a file of behaviour, for trials that were answered: BIDS keeps onset and duration out of it.
std::string header_of_behaviour();
std::string behaviour_line_of(const EventRow& row);

// The rows of each run, from 1, by their onset.
std::map<int, std::vector<EventRow>> event_rows(const SavedSession& session);

}  // namespace forceshade::experiments
