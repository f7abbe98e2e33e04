// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// polygons: a line from knot to knot, the end knots' heights beyond them.

#include "forceshade/reference/heights/jet.h"

namespace forceshade::reference {

// Where knots[right] is the first knot beyond.
template <class N>
Jet<N> stretch_jet(const height::Polygons& polygons, std::size_t right, const N& x) {
  const std::vector<height::Knot>& knots = polygons.knots;
  const auto number = [](float value) { return N(static_cast<double>(value)); };
  if (right == 0) return {number(knots.front().height), N(0.0), N(0.0)};
  if (right == knots.size()) return {number(knots.back().height), N(0.0), N(0.0)};
  const height::Knot &from = knots[right - 1], &to = knots[right];
  const N slope = (number(to.height) - number(from.height)) / (from_centre<N>(0, from.x) - from_centre<N>(0, to.x));
  return {number(from.height) + slope * (x + from_centre<N>(0, from.x)), slope, N(0.0)};
}

template <class N>
Jet<N> jet(const height::Polygons& polygons, const Point2& at) {
  const std::vector<height::Knot>& knots = polygons.knots;
  // Doubles that hold a difference's sign exactly: of binary32 numbers.
  const auto is_left_of = [&](const height::Knot& knot) { return from_centre<double>(at.x, knot.x) < 0; };
  std::size_t right = 0;  // the first knot right of the point, on which the piece ends
  while (right < knots.size() && !is_left_of(knots[right])) ++right;
  return stretch_jet(polygons, right, N(at.x));
}

}  // namespace forceshade::reference
