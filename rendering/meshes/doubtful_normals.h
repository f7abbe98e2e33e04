// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A corner normal: in binary64, with bounds of its error, and in the intervals that decide what these leave in doubt.

#include <array>
#include <optional>
#include <vector>

#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {

// The unit mean of the unit normals of the triangles with the corner first, which are not empty, weighted by their angles,
// each component rounded to nearest; zeros are +0. In binary64 only those that its errors leave no doubt of.
std::array<std::optional<float>, 3> normal_in_binary64(const std::vector<TrianglePoints>& triangles);
Normal normal_in_intervals(const std::vector<TrianglePoints>& triangles);

}  // namespace forceshade::mesh
