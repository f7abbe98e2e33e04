// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Draws with gnuplot: commands in, an <svg> element for the body of an HTML page out, or a file of its own.

#include <string>
#include <string_view>

#include "forceshade/error.h"

namespace forceshade::properties {

// gnuplot is missing or fails, in its words: a page can do without the picture.
struct PlotError : Error {
  using Error::Error;
};

struct PlotFrame {
  int width, height;        // px at 12 px text; the element scales with the page
  std::string id;           // prefix of every id inside, so that it must be unique in the page
  std::string description;  // for those who cannot see it
};

// `commands` come after the terminal is set; data go into them as $name << EOD blocks. The user's own gnuplot settings are
// not read. Needs gnuplot 5.4 on the PATH. Throws PlotError.
std::string svg_plot(const PlotFrame& frame, std::string_view commands);

struct Picture {
  PlotFrame frame;
  std::string commands;
};

inline std::string svg_plot(const Picture& picture) {
  return svg_plot(picture.frame, picture.commands);
}

// The bytes of a file: SVG, or PNG at twice the frame's pixels.
std::string svg_file(const Picture& picture);
std::string png_file(const Picture& picture);

}  // namespace forceshade::properties
