// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The list in an answer of a renderer or simulator.

#include <cstddef>
#include <nlohmann/json.hpp>

namespace forceshade::conformance {

// The list behind the key of an answer, with an entry for each of what was requested: "positions". whose: "renderer", for
// messages. Throws files::ProcessFailed.
const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& answer, const char* key, std::size_t size,
                                      const char* asked, const char* whose);

}  // namespace forceshade::conformance
