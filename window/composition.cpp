// SPDX-License-Identifier: BSD-3-Clause
#include "window/composition.h"

#include <algorithm>
#include <cstddef>

namespace forceshade::window {

double text_size(Size window) {
  return std::min(window.height / 34, window.width / 54);
}

void Composition::add_line(const std::string& words, double x, double top, double size, Colour colour, Align align) {
  if (words.empty()) return;
  if (align != Align::left) x -= measure_.width(words, size) / (align == Align::centre ? 2 : 1);
  add(Text{{x, top}, size, colour, words});
}

void Composition::add_lines(const Fitted& text, double x, double top, Colour colour, Align align) {
  for (std::size_t i = 0; i < text.lines.size(); ++i)
    add_line(text.lines[i], x, top + static_cast<double>(i) * line(text.size), text.size, colour, align);
}

void Composition::add_tip(Point centre, double radius) {
  add(Ellipse{centre, 1.18 * radius, 1.18 * radius, kWhite});
  add(Ellipse{centre, radius, radius, kCursor});
  picture_.cursor = centre;
}

}  // namespace forceshade::window
