// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// plane: U = height + slope_x·x + slope_y·y.

#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {

template <class N>
Jet<N> plane_jet(const height::Plane& plane, const N& x, const N& y) {
  const N a(static_cast<double>(plane.slope_x)), b(static_cast<double>(plane.slope_y));
  return {N(static_cast<double>(plane.height)) + a * x + b * y, a, b};
}

template <class N>
Jet<N> jet(const height::Plane& plane, const Point2& at) {
  return plane_jet(plane, N(at.x), N(at.y));
}

}  // namespace forceshade::reference
