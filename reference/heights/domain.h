// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The domain of height maps, as docs/height-maps.md states it.

#include <optional>

#include "forceshade/height_map.h"
#include "forceshade/law.h"

namespace forceshade::reference {

// The first number that is outside; stiffness: N/mm.
std::optional<ParameterError> first_error(const HeightMap& map, height::Mode mode, float stiffness);

}  // namespace forceshade::reference
