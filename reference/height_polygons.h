// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// polygons: a line from knot to knot, the end knots' heights beyond them.

#include "forceshade/reference/height_jet.h"

namespace forceshade::reference {

template <class N>
Jet<N> jet(const height::Polygons& polygons, const Point2& at) {
  const std::vector<height::Knot>& knots = polygons.knots;
  // Doubles that hold a difference's sign exactly: of binary32 numbers.
  const auto is_left_of = [&](const height::Knot& knot) { return from_centre<double>(at.x, knot.x) < 0; };
  std::size_t right = 0;  // the first knot right of the point, on which the piece ends
  while (right < knots.size() && !is_left_of(knots[right])) ++right;
  const auto number = [](float value) { return N(static_cast<double>(value)); };
  if (right == 0) return {number(knots.front().height), N(0.0), N(0.0)};
  if (right == knots.size()) return {number(knots.back().height), N(0.0), N(0.0)};
  const height::Knot &from = knots[right - 1], &to = knots[right];
  const N slope = (number(to.height) - number(from.height)) / (from_centre<N>(0, from.x) - from_centre<N>(0, to.x));
  return {number(from.height) + slope * from_centre<N>(at.x, from.x), slope, N(0.0)};
}

}  // namespace forceshade::reference
