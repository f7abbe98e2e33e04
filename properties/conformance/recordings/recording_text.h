// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A judged recording, for people and as JSON (docs/conformance.md).

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "properties/conformance/recordings/judged_recording.h"

namespace forceshade::conformance {

// Lines for a terminal, each ended.
std::string words_of(const JudgedRecording& found, const Tolerance& tolerance);
nlohmann::ordered_json json_of(const JudgedRecording& found, const Tolerance& tolerance);

// The recording's times, and the results of the fit, as names and values. A fit that is refused has none.
using Facts = std::vector<std::pair<std::string, std::string>>;
Facts facts_of(const Pace& pace, std::size_t samples, const std::string& file);
Facts facts_of(const Fit& fit, const std::string& file);

}  // namespace forceshade::conformance
