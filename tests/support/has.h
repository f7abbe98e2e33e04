// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Searches a text for a part.

#include <string>

namespace forceshade::tests {

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace forceshade::tests
