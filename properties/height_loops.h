// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What strokes of a height map can be paid, for its certificate.

#include <atomic>

#include "forceshade/fast/height_law.h"
#include "forceshade/properties/certificate.h"
#include "forceshade/reference/height_energy.h"

namespace forceshade::properties {

// Over y = 0, 12.7 mm to both sides of x = 0 or as far as 250 cells of the finest grid go.
reference::Slice certified_slice(const HeightMap& map);

// At depths of 0.5 and 2 mm, as far as they are in the domain and their bound is finite; none where the map's steepness cannot
// be decided, and none after `stop`. `fast` renders the same map.
std::vector<LoopEnergy> loop_energies(const reference::HeightLaw& law, const fast::HeightLaw& fast,
                                      const std::atomic<bool>& stop);

}  // namespace forceshade::properties
