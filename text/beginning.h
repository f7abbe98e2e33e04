// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The beginning of a text that is too long for a message.

#include <cstddef>
#include <string_view>

namespace forceshade {

// So many bytes at most, of UTF-8 not cut in the middle of a character: whoever reads UTF-8 would refuse the whole message.
inline std::string_view beginning_of(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t length = most;
  while (length > 0 && most - length < 4 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  return text.substr(0, most - length < 4 ? length : most);
}

}  // namespace forceshade
