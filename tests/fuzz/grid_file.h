// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An input as a picture or an array of heights.

#include <cmath>

#include "forceshade/heights.h"
#include "tests/fuzz/input_file.h"

namespace forceshade::fuzz {

// Loads the input as a grid, whose size and heights are then within the domain of docs/height-maps.md. An input that does not
// begin with `magic` is for another target.
inline int load_grid(std::string_view bytes, std::string_view magic) {
  if (!bytes.starts_with(magic)) return -1;
  const std::string file = file_of(bytes, "grid");
  read_or_refuse<Error>(file + ": ", [&] {
    const auto grid = heights::load({file, 0.5F, 2, height::Edge::clamp, height::Interpolant::bilinear});
    require(grid->columns >= 2 && grid->rows >= 2 && grid->values.size() == std::size_t{grid->columns} * grid->rows,
            "a grid has as many heights as it says");
    for (const float value : grid->values)
      require(value == 0 || (std::fabs(value) >= 0x1p-30F && std::fabs(value) <= 1e4F), "a height is within its domain");
  });
  return 0;
}

}  // namespace forceshade::fuzz
