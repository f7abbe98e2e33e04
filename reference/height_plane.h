// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// plane: U = height + slope_x·x + slope_y·y.

#include "forceshade/reference/height_jet.h"

namespace forceshade::reference {

template <class N>
Jet<N> jet(const height::Plane& plane, const Point2& at) {
  const N a(static_cast<double>(plane.slope_x)), b(static_cast<double>(plane.slope_y));
  return {N(static_cast<double>(plane.height)) + a * N(at.x) + b * N(at.y), a, b};
}

}  // namespace forceshade::reference
