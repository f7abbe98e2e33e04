// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a line of JSON that a child process wrote. whose: "renderer", for messages.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace forceshade::conformance {

// Both throw RendererFailed: for what is no object, or one that says why its writer failed.
nlohmann::ordered_json object_in(const std::string& said, const char* whose);

// The list behind the key of an answer, with an entry for each of what was requested: "positions".
const nlohmann::ordered_json& list_in(const nlohmann::ordered_json& answer, const char* key, std::size_t size,
                                      const char* asked, const char* whose);

}  // namespace forceshade::conformance
