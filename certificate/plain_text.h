// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Text from elsewhere that may go to a terminal: no control character is in it.

#include <string>
#include <string_view>

namespace forceshade::properties {

namespace plain_text_detail {

// ASCII controls, and of UTF-8 the two bytes of U+0080 to U+009F, which some terminals obey.
inline bool is_control(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  if (byte(i) < 0x20 || byte(i) == 0x7F) return true;
  return byte(i) == 0xC2 && i + 1 < text.size() && byte(i + 1) >= 0x80 && byte(i + 1) < 0xA0;
}

}  // namespace plain_text_detail

inline bool is_plain(std::string_view text, bool may_have_lines = false) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (plain_text_detail::is_control(text, i) && !(may_have_lines && text[i] == '\n')) return false;
  return true;
}

// With a question mark for each control character.
inline std::string made_plain(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (plain_text_detail::is_control(text, i)) {
      if (static_cast<unsigned char>(text[i]) == 0xC2) text.erase(i, 1);
      text[i] = '?';
    }
  return text;
}

}  // namespace forceshade::properties
