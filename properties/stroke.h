// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What strokes across a height map are paid: loops in one vertical slice of it (docs/energy.md, "Height maps").

#include <vector>

#include "forceshade/properties/certificate.h"
#include "forceshade/properties/subject.h"

namespace forceshade::properties {

// In the slice of reference::Slice{}, at three depths; none where the reference cannot decide the map's steepness.
std::vector<LoopEnergy> stroke_energies(const HeightSubject& subject);

}  // namespace forceshade::properties
