// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The domain of height maps, as the real-time side applies it (docs/height-maps.md).

#include <optional>

#include "forceshade/height_map.h"
#include "forceshade/law.h"

namespace forceshade::fast {

// The first number that is outside; stiffness: N/mm.
std::optional<ParameterError> first_error(const HeightMap& map, height::Mode mode, float stiffness) noexcept;

}  // namespace forceshade::fast
