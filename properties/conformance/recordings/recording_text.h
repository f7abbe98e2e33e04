// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A judged recording, for people and as JSON (docs/conformance.md).

#include <nlohmann/json.hpp>
#include <string>

#include "properties/conformance/recordings/judged_recording.h"

namespace forceshade::conformance {

// Lines for a terminal, each ended.
std::string words_of(const JudgedRecording& found, const Tolerance& tolerance);
nlohmann::ordered_json json_of(const JudgedRecording& found, const Tolerance& tolerance);

}  // namespace forceshade::conformance
