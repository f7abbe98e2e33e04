// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Text as lines on the screen.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::window {

// Widths of words in the font of a window, or in one of a test.
class Measure {
 public:
  virtual ~Measure() = default;

  // Pixels, of one line of UTF-8 in a font of this size.
  virtual double width(std::string_view words, double size) const = 0;
};

// The distance from one line to the next, as a multiple of the font's size.
inline constexpr double kLineHeight = 1.4;

// The text in lines no wider than `width`: broken at line feeds, else at spaces, else (a long word, or a language without
// spaces) between characters. A line has at least one character. Spaces at a break are left out; a text without any has one
// empty line.
std::vector<std::string> wrapped(std::string_view text, double width, double size, const Measure& measure);

// A font's size with the lines that it makes.
struct Fitted {
  double size = 0;
  std::vector<std::string> lines;

  double height() const { return static_cast<double>(lines.size()) * size * kLineHeight; }
};

// The text in the largest size up to `size` in which the text is no higher than `height`, by steps of a twentieth; below one
// pixel, where nothing can be read, in that size.
Fitted fitted(std::string_view text, double width, double height, double size, const Measure& measure);

// The code points of a text; bytes that are not UTF-8 are left out.
std::u32string code_points(std::string_view text);

// UTF-8 of a code point; empty for a surrogate and beyond U+10FFFF.
std::string utf8(char32_t code_point);

}  // namespace forceshade::window
