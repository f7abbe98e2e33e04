// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Letters of ASCII, whatever the locale: std::tolower() makes no i of I in a Turkish program.

#include <string>
#include <string_view>

namespace forceshade {

inline char small_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string small_letters(std::string_view letters) {
  std::string text(letters);
  for (char& c : text) c = small_letter(c);
  return text;
}

}  // namespace forceshade
