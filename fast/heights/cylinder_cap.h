// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder cap: a cap of ρ = |X|, the distance from its axis.

#include "fast/heights/cap.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::CylinderCap& cap, const Place& at) noexcept {
  return cap_jet(cap.radius, cap.width, difference<N>(at.x(), cap.x), N::exactly(0), at.x() < static_cast<double>(cap.x));
}

inline MaybeError error_of(const height::CylinderCap& c) noexcept {
  return first_outside({centre_x(c.x), cap_radius(c.radius), cap_width(c.radius, c.width)});
}

inline void add_terms(const height::CylinderCap& cap, const Place& at, ExactTerms& terms) noexcept {
  add_cap_terms(cap.radius, cap.width, difference<Fraction>(at.x(), cap.x), {}, at.x() < static_cast<double>(cap.x), terms);
}
inline DenominatorBits denominator_bits(const height::CylinderCap&) noexcept {
  return {0, 0, true};
}

}  // namespace forceshade::fast
