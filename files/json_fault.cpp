// SPDX-License-Identifier: BSD-3-Clause
#include "files/json_fault.h"

#include <algorithm>

#include "files/file_kind.h"
#include "files/printable.h"

namespace forceshade::files {

std::string json_fault(std::string_view text, std::size_t byte) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return "expected JSON, got an empty text";
  if (const std::string kind = binary_kind(text); !kind.empty()) return "expected JSON, got " + kind;
  if (const std::string kind = text_kind(text); !kind.empty() && kind != kJsonFile) return "expected JSON, got " + kind;
  const std::size_t at = std::min(std::max<std::size_t>(byte, 1) - 1, text.size());
  const std::string_view before = text.substr(0, at);
  const std::size_t line = 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  const std::string got = at == text.size() ? "the end of the text" : '"' + printable(text.substr(at, 1)) + '"';
  return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": expected JSON, got " + got;
}

}  // namespace forceshade::files
