// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the border of contact by halving, for the eye alone.

#include <cmath>

namespace forceshade::window {

inline constexpr double kBorderAccuracy = 0.01;  // mm

// Between one place with contact and one without, on a line: where it changes. mm.
double contact_border(double inside, double outside, const auto& is_inside) {
  while (std::fabs(outside - inside) > kBorderAccuracy) {
    const double middle = 0.5 * (inside + outside);
    (is_inside(middle) ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

}  // namespace forceshade::window
