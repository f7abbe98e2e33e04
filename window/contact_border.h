// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the border of contact by halving, for the eye alone.

#include <cmath>

namespace forceshade::window {

// Between one place with contact and one without, on a line: where it changes, within a hundredth of a millimetre. mm.
double contact_border(double inside, double outside, const auto& is_inside) {
  while (std::fabs(outside - inside) > 0.01) {
    const double middle = 0.5 * (inside + outside);
    (is_inside(middle) ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

}  // namespace forceshade::window
