// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether a text has a part.

#include <string>

namespace forceshade::tests {

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace forceshade::tests
