// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy that loops over a height map can give to the hand, for its certificate.

#include "forceshade/checks.h"
#include "properties/rendered.h"
#include "reference/height_energy.h"

namespace forceshade::properties {

// Over y = 0, 12.7 mm to both sides of x = 0 or as far as 250 cells of the finest grid go.
reference::Slice certified_slice(const HeightMap& map);

// At depths of 0.5 and 2 mm, as far as they are in the domain. Throws reference::NotEnclosed and Interrupted.
std::vector<LoopEnergy> loop_energies(const RenderedHeightMap& rendered, const Monitor& monitor = {});

}  // namespace forceshade::properties
