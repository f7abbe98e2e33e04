// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The counts and worst cases of one law or height map, in one thread or in all.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/certificate.h"
#include "forceshade/fast.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {

struct Tally {
  std::array<std::uint64_t, kAimNames.size()> aims{};
  std::array<std::uint64_t, kStageNames.size()> stages{};
  std::array<std::uint64_t, kMethodNames.size()> methods{};
  std::array<std::uint64_t, kStatusNames.size()> statuses{};
  std::array<std::uint64_t, fast::kInstructionSets.size()> sets{};
  std::uint64_t points = 0, mismatches = 0;
  ClosestCall closest_call;

  // The first kCounterexamples in the order of the chunks that they are in, whichever thread saw them.
  std::vector<std::pair<std::uint64_t, std::string>> counterexamples;

  void mismatch(std::uint64_t chunk, std::string words);

  // Counts a call. Of two equally close ones the smaller position is kept, so that the order of threads does not matter.
  void call(const ClosestCall& other);

  void add(const Tally& other);

  Comparison comparison() const;
};

}  // namespace forceshade::properties
