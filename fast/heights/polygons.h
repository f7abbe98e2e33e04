// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// polygons: a line from knot to knot, the end knots' heights beyond them.

#include <algorithm>

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"

namespace forceshade::fast {

// The jet of polygons with knots whose x are quantised. Level pieces are level in every arithmetic.
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

inline MaybeError error_of(const height::Polygons& p) noexcept {
  using namespace height_limits;
  if (const auto error = first_outside({{"number of knots", "", static_cast<float>(p.knots.size()), kFewestKnots, kMostKnots}}))
    return error;
  for (const height::Knot& knot : p.knots) {
    if (const auto error = first_outside({symmetric("knot x", "mm", knot.x, kLargestCoordinate)})) return error;
    if (const auto error = error_of_value(knot.height)) return error;
  }
  for (std::size_t i = 1; i < p.knots.size(); ++i) {
    const double step = static_cast<double>(p.knots[i].x) - static_cast<double>(p.knots[i - 1].x);
    if (!(step >= static_cast<double>(kSmallestReach)))
      return ParameterError{"step between knots", "mm", static_cast<float>(step), kSmallestReach, 2 * kLargestCoordinate};
  }
  return std::nullopt;
}

inline void add_terms(const height::Polygons& polygons, const Place& at, ExactTerms& terms) noexcept {
  terms.add_rational(jet<Fraction>(polygons, at));
}
// The step between knots, a multiple of 2⁻⁵³ below 2¹⁶.
inline DenominatorBits denominator_bits(const height::Polygons&) noexcept {
  return {69, 69};
}

}  // namespace forceshade::fast
