// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// RapidCheck's generator of height maps themselves.

#include <rapidcheck.h>

#include "properties/rendered.h"

namespace forceshade::properties {

struct AnyHeightMap {
  HeightMap map;
  height::Mode mode = height::Mode::true_height;
  float stiffness = 1;  // N/mm
};

// One to three parts of any kind, numbers by bit pattern within their domains or of a hand's size, grids of few samples. Every
// one can be built. Shrinks to fewer parts.
rc::Gen<AnyHeightMap> any_height_map();

std::ostream& operator<<(std::ostream& out, const AnyHeightMap& any);

}  // namespace forceshade::properties
