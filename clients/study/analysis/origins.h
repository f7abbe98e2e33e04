// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The origin of trials, which every page and table says: who answered, on which devices, and whether forces were certified.

#include <map>
#include <string>
#include <vector>

#include "study/experiments/results.h"

namespace forceshade::analysis {

struct Origins {
  std::vector<std::string> people, models, not_recorded;    // participants, in the order of the results
  std::map<std::string, std::size_t> devices;               // trials by device; "" where it was not recorded
  std::size_t certified = 0, uncertified = 0, unknown = 0;  // trials by their forces

  bool are_virtual() const { return !models.empty(); }
};

Origins origins_of(const experiments::Results& results);

// The reason why these trials must not be analysed together: some are a model's and others are not. Empty where they may be.
std::string fault_of(const Origins& origins);

// Whole sentences; none where there are no trials.
std::vector<std::string> sentences_of(const Origins& origins);

// "person", "virtual participant", "not recorded", joined by " and " where a participant is of more than one kind; of all
// participants for kOverall.
std::string answered_by(const Origins& origins, const std::string& participant);

}  // namespace forceshade::analysis
