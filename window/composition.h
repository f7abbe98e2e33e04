// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common part of the pictures of all windows: their colours, their lines of text, and the look of the tip.

#include <cstdint>
#include <string>
#include <utility>

#include "window/picture.h"
#include "window/text.h"

namespace forceshade::window {

// Contrast with the paper at least 5 to 1 for all text, and 3 to 1 for what else carries meaning (WCAG 2.1, 1.4.3 and 1.4.11).
inline constexpr Colour kInk{0.125F, 0.145F, 0.169F}, kMuted{0.349F, 0.384F, 0.420F}, kAccent{0.129F, 0.369F, 0.569F},
    kWhite{1, 1, 1}, kRule{0.776F, 0.765F, 0.737F};

// These are the colours that tests look for.
inline constexpr Colour kPaper{0.965F, 0.961F, 0.949F}, kPanel{0.925F, 0.918F, 0.898F}, kCursor{0.784F, 0.251F, 0.141F};

// Pixels: the size of the body of all text in a window of this size, where the settings do not scale it.
double text_size(Size window);

// The point of a line of text at its x.
enum class Align : std::uint8_t { left, centre, right };

// A picture on paper while it is put together. Pixels.
class Composition {
 protected:
  explicit Composition(const Measure& measure) : measure_(measure) { picture_.background = kPaper; }

  void add(Item item) { picture_.items.push_back(std::move(item)); }

  static double line(double size) { return size * kLineHeight; }

  void add_line(const std::string& words, double x, double top, double size, Colour colour, Align align = Align::left);
  void add_lines(const Fitted& text, double x, double top, Colour colour, Align align = Align::left);

  // The ball that stands for the tip, with a white rim.
  void add_tip(Point centre, double radius);

  const Measure& measure_;
  Picture picture_;
};

}  // namespace forceshade::window
