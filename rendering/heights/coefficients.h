// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Computes the coefficients of the cubic B-spline that passes through given heights.

#include <cstdint>
#include <vector>

#include "forceshade/height_map.h"

namespace forceshade::heights {

// Replaces the heights, row by row, by the coefficients. Computed in binary64 and rounded once: at each sample the spline is
// within 2^-24 of its largest coefficient there of the height given.
void make_coefficients(std::vector<float>& values, std::uint32_t columns, std::uint32_t rows, height::Edge edge);

}  // namespace forceshade::heights
