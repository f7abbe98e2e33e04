// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of the thesis, drawn again from the laws themselves.

#include <array>
#include <string>
#include <vector>

#include "report/gnuplot.h"

namespace forceshade::properties {

struct ThesisFigure {
  std::string name;  // for instance "figure-4-2"
  Picture picture;
  std::string csv;  // its numbers, with a header that has units
};

// 2-3, 4-2, 5-1, 5-4 and 5-5. What the thesis does not print (the function of 2-3, the middle bump of 5-1) is stated in the
// picture's description.
std::vector<ThesisFigure> thesis_figures();

// The bumps of the thesis's experiments (5.5): five radii, one width.

struct ThesisRadius {
  int mil;
  float mm;
};

inline constexpr std::array<ThesisRadius, 5> kThesisRadii{
    {{600, 15.24F}, {800, 20.32F}, {1000, 25.4F}, {1200, 30.48F}, {1400, 35.56F}}};
inline constexpr float kThesisWidth = 25.4F;  // mm: 1000 mil

}  // namespace forceshade::properties
