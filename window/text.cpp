// SPDX-License-Identifier: BSD-3-Clause
#include "window/text.h"

#include <algorithm>

#include "files/printable.h"

namespace forceshade::window {
namespace {

// The bytes that are drawn as one: a character of UTF-8, or a byte that begins none.
std::size_t step(std::string_view text) {
  return std::max<std::size_t>(1, files::character_size(text));
}

// As many characters of the word as fit, at least one.
std::size_t fitting(std::string_view word, double width, double size, const Measure& measure) {
  std::size_t end = step(word);
  while (end < word.size()) {
    const std::size_t next = end + step(word.substr(end));
    if (measure.width(word.substr(0, next), size) > width) break;
    end = next;
  }
  return end;
}

void wrap_paragraph(std::string_view paragraph, double width, double size, const Measure& measure,
                    std::vector<std::string>& lines) {
  std::string line;
  while (!paragraph.empty()) {
    const std::size_t spaces = std::min(paragraph.find_first_not_of(' '), paragraph.size());
    const std::size_t end = std::min(paragraph.find(' ', spaces), paragraph.size());
    const std::string longer = line + std::string(paragraph.substr(0, end));
    if (measure.width(longer, size) <= width) {
      line = longer;
      paragraph.remove_prefix(end);
    } else if (!line.empty()) {
      lines.push_back(line);
      line.clear();
      paragraph.remove_prefix(spaces);
      if (paragraph.empty()) return;
    } else {
      paragraph.remove_prefix(spaces);
      if (paragraph.empty()) break;
      const std::size_t part = fitting(paragraph.substr(0, end - spaces), width, size, measure);
      line = paragraph.substr(0, part);
      paragraph.remove_prefix(part);
    }
  }
  lines.push_back(line);
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, double width, double size, const Measure& measure) {
  std::vector<std::string> lines;
  for (;;) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    wrap_paragraph(text.substr(0, end), width, size, measure, lines);
    if (end == text.size()) return lines;
    text.remove_prefix(end + 1);
  }
}

Fitted fitted(std::string_view text, double width, double height, double size, const Measure& measure) {
  Fitted result;
  for (;; size *= 0.95) {
    result.size = size;
    result.lines = wrapped(text, width, size, measure);
    if (result.height() <= height || size < 1) return result;
  }
}

std::u32string code_points(std::string_view text) {
  std::u32string all;
  while (!text.empty()) {
    const std::size_t size = files::character_size(text);
    if (size > 0) {
      const auto byte = [&](std::size_t i) { return static_cast<char32_t>(static_cast<unsigned char>(text[i])); };
      char32_t point = size == 1 ? byte(0) : byte(0) & (0x7FU >> size);
      for (std::size_t i = 1; i < size; ++i) point = point << 6 | (byte(i) & 0x3F);
      all += point;
    }
    text.remove_prefix(std::max<std::size_t>(1, size));
  }
  return all;
}

std::string utf8(char32_t point) {
  if (point > 0x10FFFF || (0xD800 <= point && point < 0xE000)) return {};
  if (point < 0x80) return {static_cast<char>(point)};
  std::string bytes;
  const int following = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
  bytes += static_cast<char>((0xF00U >> (following + 1) & 0xFF) | point >> (6 * following));
  for (int i = following - 1; i >= 0; --i) bytes += static_cast<char>(0x80 | (point >> (6 * i) & 0x3F));
  return bytes;
}

}  // namespace forceshade::window
