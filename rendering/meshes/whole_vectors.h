// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A triangle's sides and its normal, exactly.

#include <array>

#include "rendering/meshes/interval.h"
#include "rendering/meshes/whole_coordinate.h"
#include "rendering/vectors.h"

namespace forceshade::mesh {

using WholeVector = std::array<Whole, 3>;

// over/under, under > 0.
struct WholeFraction {
  Whole over, under = 1;

  bool operator<(const WholeFraction& other) const { return over * other.under < other.over * under; }
};

// From a to b, in units of 2^-53 mm.
inline WholeVector side(const Vertex& a, const Vertex& b) {
  const auto step = [&](std::size_t i) -> Whole { return whole_coordinate<Whole>(b[i]) - whole_coordinate<Whole>(a[i]); };
  return {step(0), step(1), step(2)};
}

}  // namespace forceshade::mesh
