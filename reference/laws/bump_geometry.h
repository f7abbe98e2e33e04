// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The geometry of a bump: R, w and K as given, and d, h, w′, h′ as the thesis defines them (4.2 to 4.4.3).

#include "forceshade/law.h"
#include "reference/numbers/ball64.h"

namespace forceshade::reference {

template <class N>
struct BumpGeometry {
  N R, w, K;  // mm, mm, N/mm
  N d;        // mm: depth of the cylinder's axis below the plane
  N h;        // mm: height of the bump
  N w_prime;  // mm: width of the flat top
  N h_prime;  // mm: height of the flat top
};

// To about 19 digits, from the enclosing geometry (slow_geometry.h) rounded outwards.
BumpGeometry<Ball64> filter_geometry(const Parameters& parameters);

}  // namespace forceshade::reference
