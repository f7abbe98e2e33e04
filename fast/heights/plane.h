// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// plane: U = height + slope_x·x + slope_y·y.

#include "fast/heights/check.h"
#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::Plane& plane, const Place& at) noexcept {
  const N a = N::exactly(static_cast<double>(plane.slope_x)), b = N::exactly(static_cast<double>(plane.slope_y));
  return {(N::exactly(static_cast<double>(plane.height)) + a * N::exactly(at.x())) + b * N::exactly(at.y()), a, b};
}

inline MaybeError error_of(const height::Plane& p) noexcept {
  using height_limits::kLargestSlope;
  return first_outside({symmetric("slope x", "", p.slope_x, kLargestSlope), symmetric("slope y", "", p.slope_y, kLargestSlope),
                        height_of(p.height)});
}

inline void add_terms(const height::Plane& plane, const Place& at, ExactTerms& terms) noexcept {
  terms.add_rational(jet<Fraction>(plane, at));
}
inline DenominatorBits denominator_bits(const height::Plane&) noexcept {
  return {};
}

}  // namespace forceshade::fast
