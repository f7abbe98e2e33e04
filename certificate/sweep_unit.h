// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One unit of a sweep: the fast path against the reference at 2^22 bit patterns and their negatives.

#include "forceshade/certify.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::properties {

inline constexpr std::size_t kSweepCounterexamples = 10;

struct UnitTally {
  std::uint64_t inputs = 0, mismatches = 0;
  std::array<std::uint64_t, 3> stages{};
  std::vector<std::string> counterexamples;  // the first kSweepCounterexamples
};

// unit: below kUnitsPerSweep. The laws are those of the sweep.
UnitTally check_unit(const Sweep& sweep, const fast::Law& law, const reference::Law& reference, std::uint32_t unit);

}  // namespace forceshade::properties
