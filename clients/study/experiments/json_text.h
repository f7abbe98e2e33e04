// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// JSON in the files of a session, with refusals that name the key. Included by source files alone.

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace forceshade::experiments {

using Json = nlohmann::ordered_json;

// Throws std::invalid_argument for a text that is no JSON or nests deeper than 16 levels, which no file of a session does: the
// library prints and compares values by recursion.
Json json_of(std::string_view text);

// The member `key` of an object; what is missing or of another type throws std::invalid_argument with the key, what was
// expected and what was got.
const Json& member(const Json& object, const std::string& key);
int whole_member(const Json& object, const std::string& key, int least = std::numeric_limits<int>::min(),
                 int largest = std::numeric_limits<int>::max());
std::string text_member(const Json& object, const std::string& key);

}  // namespace forceshade::experiments
