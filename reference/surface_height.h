// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The height of a height map's surface, by its definition.

#include "forceshade/height_map.h"

namespace forceshade::reference {

// U at a place of the plane within the domain, mm: the binary32 nearest to the exact one, ties to even; zero is +0. A
// coordinate below 2^-30 mm in size is 0, as in a position. The map is one of which HeightMapField was built.
float surface_height(const HeightMap& map, float x, float y);

}  // namespace forceshade::reference
