// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The corner normal that binary64 leaves in doubt.

#include <vector>

#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {

// The unit mean of the unit normals of the triangles with the corner first, which are not empty, weighted by their angles,
// each component rounded to nearest; zeros are +0.
Normal normal_in_intervals(const std::vector<TrianglePoints>& triangles);

}  // namespace forceshade::mesh
