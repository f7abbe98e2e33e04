// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Computes the coefficients of the cubic B-spline that passes through given heights.

#include <cmath>
#include <cstdint>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/height_map.h"

namespace forceshade::heights {

// Replaces the heights, row by row, by the coefficients. Computed in binary64 and rounded once: at each sample the spline is
// within 2^-24 of its largest coefficient there of the height given. Throws Interrupted, with the values as they were.
void make_coefficients(std::vector<float>& values, std::uint32_t columns, std::uint32_t rows, height::Edge edge,
                       const Monitor& monitor = {});

// A height or a coefficient (mm) as a grid has it: below 2^-30 mm in size it is 0.
inline float without_tiny(float value) {
  return std::fabs(value) < 0x1p-30F ? 0.0F : value;
}

}  // namespace forceshade::heights
