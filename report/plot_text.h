// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that the figures of all reports share: commands of gnuplot for axes, and the <figure> around the panels.

#include <string>
#include <vector>

namespace forceshade::properties {

// A number for gnuplot, with enough digits for a plot; "NaN", which it leaves out, for what is not finite.
std::string plotted(double value);

// Commands of gnuplot. Axis is "x" or "y"; margins are fractions of the panel, seen from its lower left corner.
inline constexpr const char* kPlain =
    "set border 3 lc rgb '#777777'\n"
    "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
    "set format '%g'\n"
    "unset key\n";
inline constexpr const char* kXName =
    "set xlabel \"{/:Italic x} (mm)\" offset 0, 0.7 textcolor rgb '#333333'\nset xtics offset 0, 0.3\n";
std::string range(const char* axis, double low, double high);
std::string margins(double left, double right, double top, double bottom);
// At 1, 2 or 5 times a power of ten, at most `count` of them over `length`.
std::string ticks(const char* axis, double length, int count);
// Names the vertical axis above its upper end, to be read without turning the head.
std::string vertical_name(const char* text);

// The text in single quotes, as it stands; a control character becomes a space.
std::string quoted(const std::string& text);

struct Panel {
  std::string heading;  // HTML
  std::string svg;
};

std::string legend_line(const std::string& border_colour, const std::string& words);

// columns: "two", "three" or "four", as many as fit. Everything is HTML; an empty legend is left out.
std::string figure(int number, const char* columns, const std::string& title, const std::string& legend,
                   const std::vector<Panel>& panels, const std::string& caption);

}  // namespace forceshade::properties
