// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// plane: U = height + slope_x·x + slope_y·y.

#include "forceshade/fast/heights/jet.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::Plane& plane, const Place& at) noexcept {
  const N a = N::exactly(static_cast<double>(plane.slope_x)), b = N::exactly(static_cast<double>(plane.slope_y));
  return {(N::exactly(static_cast<double>(plane.height)) + a * N::exactly(at.x())) + b * N::exactly(at.y()), a, b};
}

}  // namespace forceshade::fast
