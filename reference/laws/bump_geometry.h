// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The geometry of a bump: R, w and K as given, and d, h, w′, h′ as the thesis defines them (4.2 to 4.4.3).

#include "forceshade/law.h"

namespace forceshade::reference {

template <class N>
struct BumpGeometry {
  N R, w, K;  // mm, mm, N/mm
  N d;        // mm: depth of the cylinder's axis below the plane
  N h;        // mm: height of the bump
  N w_prime;  // mm: width of the flat top
  N h_prime;  // mm: height of the flat top
};

// The same geometry in other numbers.
template <class N, class Convert>
auto converted(const BumpGeometry<N>& g, const Convert& convert) {
  return BumpGeometry<decltype(convert(g.R))>{convert(g.R), convert(g.w),       convert(g.K),      convert(g.d),
                                              convert(g.h), convert(g.w_prime), convert(g.h_prime)};
}

}  // namespace forceshade::reference
