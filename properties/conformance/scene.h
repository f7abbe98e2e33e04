// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The scene with all of its numbers, as JSON for programs that know nothing of this one (docs/conformance-protocol.md).

#include <nlohmann/json.hpp>
#include <span>

#include "forceshade/description.h"

namespace forceshade::conformance {

nlohmann::ordered_json scene_of(const Description& description);

// As hexfloat, "nan", "inf" or "-inf".
nlohmann::ordered_json hexfloats(std::span<const float> numbers);

}  // namespace forceshade::conformance
