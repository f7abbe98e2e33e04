// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map of every kind and a sum, with its height written down a second time, in binary64.

#include "tests/height_maps/height_kinds.h"

namespace forceshade {

inline std::vector<HeightExample> height_examples() {
  std::vector<HeightExample> all = tests::examples_of_every_kind();
  all.push_back({"dent in waves",
                 {{{height::SphereCap{1, -0.5F, 5, 8}, true}, {height::Grating{0.25F, 2, 0.5F, 0.3F}}}},
                 [](double x, double y) {
                   return 0.25 * std::cos(2 * x + 0.5 * y + 0.3) - tests::cap_height(5, 8, std::hypot(x - 1, y + 0.5));
                 }});
  return all;
}

}  // namespace forceshade
