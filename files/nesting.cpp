// SPDX-License-Identifier: BSD-3-Clause
#include "files/nesting.h"

#include <algorithm>
#include <string>

namespace forceshade::files {
namespace {

// Behind the text in quotes, or the comment, that begins at `at`. On one line it ends with the line, closed or not.
std::size_t behind(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (quote == '#') return std::min(text.find('\n', at), text.size());
  const std::string three(3, quote);
  const bool has_lines = text.substr(at, 3) == three;
  for (at += has_lines ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\')
      ++at;
    else if (!has_lines && text[at] == '\n')
      return at;
    else if (!has_lines && text[at] == quote)
      return at + 1;
    else if (has_lines && text.substr(at, 3) == three)
      // Up to two more quotes still belong to the text.
      return std::min({text.find_first_not_of(quote, at + 3), at + 5, text.size()});
  }
  return text.size();
}

}  // namespace

std::optional<std::uint32_t> line_nested_too_deep(std::string_view text) {
  std::size_t brackets = 0, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'' || c == '#') {
      at = behind(text, at);
      continue;
    }
    ++at;
    if (c == '.') {
      ++dots;
    } else if (c == '[' || c == '{') {
      ++brackets;
      dots = 0;
    } else if (c == ']' || c == '}') {
      brackets -= brackets > 0 ? 1 : 0;
      dots = 0;
    } else if (c == '\n' || c == '=' || c == ',') {
      dots = 0;
    }
    if (brackets > kMostBrackets || dots > kMostDots)
      return static_cast<std::uint32_t>(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }
  return std::nullopt;
}

}  // namespace forceshade::files
