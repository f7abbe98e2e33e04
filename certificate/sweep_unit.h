// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One unit of a sweep: the fast path against the reference at 2^22 bit patterns and their negatives.

#include "certificate/tally.h"
#include "forceshade/certify.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::properties {

// unit: below kUnitsPerSweep. The laws are those of the sweep. The tally counts points, mismatches and stages.
Tally check_unit(const Sweep& sweep, const fast::Law& law, const reference::Law& reference, std::uint32_t unit);

// The same with the laws of the sweep, which are in their domain.
Tally check_unit(const Sweep& sweep, std::uint32_t unit);

// Adds what units of one of the sweeps found; in the order of the units where counterexamples are to be the first ones.
void add(Sweeps& sweeps, std::size_t sweep, const Tally& tally);

}  // namespace forceshade::properties
