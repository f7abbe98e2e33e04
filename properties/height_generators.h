// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The generator of height maps themselves.

#include "properties/rendered.h"

namespace forceshade::properties {

struct AnyHeightMap {
  HeightMap map;
  height::Mode mode = height::Mode::true_height;
  float stiffness = 1;  // N/mm
};

// One to three parts of any kind, numbers by bit pattern within their domains or of a hand's size, grids of few samples. Every
// one can be built. Simpler ones have fewer parts.
Generator<AnyHeightMap> any_height_map();

}  // namespace forceshade::properties
