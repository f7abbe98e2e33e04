// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Heights without waves that are too short to be sampled well, or that should not be felt.

#include <cstdint>
#include <vector>

#include "forceshade/height_map.h"

namespace forceshade::heights {

// Filters the heights in place, row by row: each wave of length l is multiplied by 1 for l >= 2L, by 0 for l <= L, and between
// by a raised cosine, (1 - cos(2π L/l))/2; L, in samples, at least 4. Waves are those of the grid repeated (tile), or mirrored
// half a sample beyond its edges and then repeated (clamp), so that opposite edges do not affect each other. Computed in
// binary64 and rounded once.
void limit_band(std::vector<float>& heights, std::uint32_t columns, std::uint32_t rows, height::Edge edge,
                double shortest_wavelength);

}  // namespace forceshade::heights
