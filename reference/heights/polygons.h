// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// polygons: a line from knot to knot, the end knots' heights beyond them.

#include <algorithm>
#include <vector>

#include "reference/heights/kind.h"

namespace forceshade::reference {

// The jet at x; knots[right] is the first knot beyond.
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

template <>
constexpr Formula formula<height::Polygons>() {
  return Formula::polynomial;
}

inline DomainError error_of(const height::Polygons& p) {
  if (const auto error = check("number of knots", "", static_cast<float>(p.knots.size()), 2, 1025)) return error;
  for (const height::Knot& knot : p.knots) {
    if (const auto error = check("knot x", "mm", knot.x, -10000, 10000)) return error;
    if (const auto error = check_value(knot.height)) return error;
  }
  for (std::size_t i = 1; i < p.knots.size(); ++i) {
    const double step = static_cast<double>(p.knots[i].x) - static_cast<double>(p.knots[i - 1].x);
    if (step < static_cast<double>(0.001F))
      return ParameterError{"step between knots", "mm", static_cast<float>(step), 0.001F, 20000};
  }
  return std::nullopt;
}

// The column counts the knots that lie behind, seen from smaller x.
inline void cut(const height::Polygons& polygons, Cuts& cuts) {
  const auto from = static_cast<double>(cuts.segment().x0), to = static_cast<double>(cuts.segment().x1);
  for (const height::Knot& knot : polygons.knots) {
    const auto x = -from_centre<double>(0, knot.x);
    if (x < from || (x == from && !(to < from))) ++cuts.cells.back().column;
    if (!((from < x && x < to) || (to < x && x < from))) continue;
    const auto t = [&]<class N>() -> N { return (N(x) - Cuts::number<N>(cuts.segment().x0)) / cuts.along_x<N>(); };
    cuts.add(t, {from < to ? 1 : -1, 0});
  }
}
template <class N>
Jet<N> jet_in(const height::Polygons& polygons, const OnWay<N>& at) {
  return stretch_jet(polygons, static_cast<std::size_t>(at.cell.column), at.x);
}

inline std::optional<ConstantGradient> constant_gradient(const height::Polygons& p) {
  return level_if(std::ranges::all_of(p.knots, [&](const height::Knot& knot) { return knot.height == p.knots[0].height; }));
}

inline double tallest(const height::Polygons& p, double, double) {
  double most = 0;
  for (const height::Knot& knot : p.knots) most = std::max(most, size_of(knot.height));
  return most;
}

inline Outline outline_of(const height::Polygons& polygons) {
  Outline shape{.kind = "polygons"};
  const std::vector<height::Knot>& knots = polygons.knots;
  const auto slope = [&](std::size_t i) {
    const double run = static_cast<double>(placed(knots[i + 1].x)) - static_cast<double>(placed(knots[i].x));
    return (static_cast<double>(knots[i + 1].height) - static_cast<double>(knots[i].height)) / run;
  };
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) shape.steepest = std::max(shape.steepest, std::fabs(slope(i)));
  for (const height::Knot& knot : knots) shape.xs.push_back(placed(knot.x));
  shape.x = 0.5 * (static_cast<double>(shape.xs.front()) + static_cast<double>(shape.xs.back()));
  shape.reach = 1.3 * (static_cast<double>(shape.xs.back()) - shape.x);
  if (shape.steepest > 0) shape.kinks = {"its knots"};
  shape.gradient_change = [xs = shape.xs](double x, double, double reach) {
    const auto is_near = [&](float knot) { return std::fabs(static_cast<double>(knot) - x) <= reach + kOutlineSlack; };
    return GradientChange{0, std::any_of(xs.begin(), xs.end(), is_near)};
  };
  return shape;
}

}  // namespace forceshade::reference
