// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Draws with gnuplot: commands in, an <svg> element for the body of an HTML page out.

#include <stdexcept>
#include <string>
#include <string_view>

namespace forceshade::properties {

// gnuplot is missing or failed; what() has its words.
struct PlotError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct PlotFrame {
  int width, height;        // px at 12 px text; the element scales with the page
  std::string id;           // prefix of every id inside, so that it must be unique in the page
  std::string description;  // for those who cannot see it
};

// `commands` come after the terminal is set; data go into them as $name << EOD blocks. The user's own gnuplot settings are
// not read. Needs gnuplot 5.4 on the PATH.
std::string svg_plot(const PlotFrame& frame, std::string_view commands);

}  // namespace forceshade::properties
