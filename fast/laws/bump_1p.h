// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-1p: one polygon, unshaded (thesis 4.4.1): H = 0 and D = ẑ, which is the wall.

#include "fast/laws/wall.h"

namespace forceshade::fast {

struct Bump1p : Wall {
  using Wall::Wall;
};

}  // namespace forceshade::fast
