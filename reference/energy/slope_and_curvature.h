// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The slope, the curvature and the kinks of each part of a height map along the line y = 0, over a whole stretch of it at once.

#include <vector>

#include "forceshade/height_map.h"
#include "reference/heights/section.h"

namespace forceshade::reference {

// Enclosures for every x of a stretch that holds `inside` and has no kink or grid line in its interior; `inside` is not at its
// ends, which belong to it whatever kinks there. Callers hold exact_arithmetic.
SlopeAndCurvature slope_and_curvature(const std::vector<height::Part>& parts, const Enclosure& x, double inside);

// The kink strictly between the two, if there is one.
Kink kink_between(const height::Part& part, double from, double to);

// Adds the x of a spline's grid lines strictly between the two. Throws std::invalid_argument for more than `most` of them.
void add_grid_lines(const height::Part& part, double from, double to, std::size_t most, std::vector<double>& lines);

}  // namespace forceshade::reference
