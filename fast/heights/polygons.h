// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// polygons: a line from knot to knot, the end knots' heights beyond them.

#include <algorithm>

#include "forceshade/fast/heights/jet.h"

namespace forceshade::fast {

// Of knots whose x are quantised. Level pieces are level in every arithmetic.
template <class N>
Jet<N> jet(const height::Polygons& polygons, const Place& at) noexcept {
  const auto& knots = polygons.knots;
  const auto right = std::upper_bound(knots.begin(), knots.end(), at.x(),
                                      [](double x, const height::Knot& knot) { return x < static_cast<double>(knot.x); });
  const auto left = right == knots.begin() ? right : right - 1;
  const N height = N::exactly(static_cast<double>(left->height));
  if (left == right || right == knots.end() || left->height == right->height) return {height, N::exactly(0), N::exactly(0)};
  const N slope =
      difference<N>(static_cast<double>(right->height), left->height) / difference<N>(static_cast<double>(right->x), left->x);
  return {height + slope * difference<N>(at.x(), left->x), slope, N::exactly(0)};
}

}  // namespace forceshade::fast
