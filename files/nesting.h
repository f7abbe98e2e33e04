// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The depth of nesting of a TOML text, known before it is parsed: a parser and its tables call themselves once for each level.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace forceshade::files {

// Brackets within brackets, and parts of one dotted key. A height map needs 2 brackets, or 3 in a line, and no dotted key; the
// tables of a text within these limits are some 16 * 17 deep at most, once for a header and once for a key.
inline constexpr std::size_t kMostBrackets = 16, kMostDots = 16;

// The line, from 1, of the first bracket or dot beyond these limits. What stands in quotes and comments does not count, by the
// rules of TOML 1.0; where a text breaks them, a parser stops there too.
std::optional<std::uint32_t> line_nested_too_deep(std::string_view text);

}  // namespace forceshade::files
