// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of the thesis, drawn again from the laws themselves.

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

}  // namespace forceshade::properties
