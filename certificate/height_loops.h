// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What strokes of a height map can be paid, for its certificate.

#include <functional>

#include "forceshade/certificate/certificate.h"
#include "forceshade/fast/height_map_field.h"
#include "forceshade/reference/height_energy.h"

namespace forceshade::properties {

// Over y = 0, 12.7 mm to both sides of x = 0 or as far as 250 cells of the finest grid go.
reference::Slice certified_slice(const HeightMap& map);

// At depths of 0.5 and 2 mm, as far as they are in the domain. `fast` renders the same map. Throws reference::NotEnclosed and
// reference::Interrupted.
std::vector<LoopEnergy> loop_energies(const reference::HeightMapField& law, const fast::HeightMapField& fast,
                                      const reference::Watch& watch = {});

// Puts what energies() gives into the findings. Where that is not enclosed, no number is: passivity has failed, and its
// counterexample says why.
void add_loop_energies(Findings& findings, const std::function<std::vector<LoopEnergy>()>& energies);

}  // namespace forceshade::properties
