// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The order of a session: blocks and their trials, in an order that follows from a seed alone.

#include <cstdint>
#include <string>
#include <vector>

#include "study/experiments/protocol.h"
#include "study/experiments/results.h"

namespace forceshade::experiments {

// The condition of one trial.
struct Trial {
  int number = 0;  // from 1 in the order of the session, practice left out; 0 in practice
  std::string stimulus;
  Mil radius = 0;  // of the reference, or of the bump that is classified
  InitialRadius initial = InitialRadius::same;
  Mil initial_radius = 0;  // of the matching bump; 0 in the classification experiment
  int repetition = 0;      // from 1

  friend bool operator==(const Trial&, const Trial&) = default;
};

struct Block {
  int number = 0;  // from 1; 0 for practice
  bool is_practice = false;
  bool vision = true;
  std::vector<Trial> trials;
};

// The matching experiment has a block for each stimulus and each of vision, where reference radii, initial radii and
// repetitions come in random order (thesis 5.5); the classification experiment has one block of all its trials in random order.
// Practice comes first, with conditions drawn from the first block. The same protocol and seed give the same order on every
// machine.
std::vector<Block> order(const Protocol& protocol, std::uint64_t seed);

}  // namespace forceshade::experiments
