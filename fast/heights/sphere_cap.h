// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// sphere cap: a cap of ρ, the distance from its centre.

#include "fast/heights/cap.h"

namespace forceshade::fast {

template <class N>
Jet<N> jet(const height::SphereCap& cap, const Place& at) noexcept {
  return cap_jet(cap.radius, cap.width, difference<N>(at.x(), cap.x), difference<N>(at.y(), cap.y),
                 at.x() < static_cast<double>(cap.x));
}

inline MaybeError error_of(const height::SphereCap& c) noexcept {
  return first_outside({centre_x(c.x), centre_y(c.y), cap_radius(c.radius), cap_width(c.radius, c.width)});
}

inline void add_terms(const height::SphereCap& cap, const Place& at, ExactTerms& terms) noexcept {
  add_cap_terms(cap.radius, cap.width, difference<Fraction>(at.x(), cap.x), difference<Fraction>(at.y(), cap.y),
                at.x() < static_cast<double>(cap.x), terms);
}
inline DenominatorBits denominator_bits(const height::SphereCap&) noexcept {
  return {0, 0, true};
}

}  // namespace forceshade::fast
