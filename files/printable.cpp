// SPDX-License-Identifier: BSD-3-Clause
#include "files/printable.h"

#include <array>
#include <cstdio>

#include "text/beginning.h"

namespace forceshade::files {
namespace {

// `character` is one of UTF-8.
bool is_command(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7F;
  if (character.size() == 2) return byte(0) == 0xC2 && byte(1) < 0xA0;  // C1: U+0080 to U+009F
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  if (byte(1) == 0x80) return byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE);
  return byte(1) == 0x81 && byte(2) >= 0xA6 &&
         byte(2) <= 0xA9;  // with the line above: U+200E, 200F, 2028 to 202E, 2066 to 2069
}

}  // namespace

std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) > 0x9F;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool beyond_unicode = first == 0xF4 && byte(1) > 0x8F;
    return follows(1) && follows(2) && follows(3) && !overlong && !beyond_unicode ? 4 : 0;
  }
  return 0;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, size == 0 ? 1 : size);
    text.remove_prefix(character.size());
    if (size > 0 && !is_command(character)) {
      result += character;
      continue;
    }
    if (character == "\n") {
      result += "\\n";
      continue;
    }
    for (const char byte : character) {
      std::array<char, 5> hex{};
      std::snprintf(hex.data(), hex.size(), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
      result += hex.data();
    }
  }
  return result;
}

bool is_printable(std::string_view text, bool may_have_lines) {
  if (!may_have_lines) return printable(text) == text;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    if (!is_printable(text.substr(0, end))) return false;
    text.remove_prefix(end + 1);
  }
  return is_printable(text);
}

std::string shown(std::string_view text, std::size_t length) {
  return '"' + printable(beginning_of(text, length)) + (text.size() > length ? "...\"" : "\"");
}

}  // namespace forceshade::files
