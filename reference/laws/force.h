// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a law answers: first the facet (which formula holds at a position: decisions), then the force on it (values).

#include "forceshade/reference/laws/bump_geometry.h"

namespace forceshade::reference {

enum class Facet { none, plane, cylinder, cylinder_and_plane, axis, top, left, right };

template <class N>
struct Force {
  N x, z;       // N
  N magnitude;  // N: of one object's push before it is given its direction; of a sum, the cylinder's
};

// Magnitude along a direction.
template <class N>
Force<N> along(const N& magnitude, const N& direction_x, const N& direction_z) {
  return {magnitude * direction_x, magnitude * direction_z, magnitude};
}

template <class N>
Force<N> no_force() {
  return {N(0.0), N(0.0), N(0.0)};
}

template <class N>
N size_of(const N& x) {
  return x < N(0.0) ? -x : x;
}

// 2|x| <= w.
template <class N>
bool is_within_width(const BumpGeometry<N>& g, const N& x) {
  return N(2.0) * size_of(x) <= g.w;
}

// The direction of force shading: the cylinder's normal above x, (x/R, √(R² - x²)/R).
template <class N>
Force<N> along_shaded(const BumpGeometry<N>& g, const N& magnitude, const N& x) {
  return along(magnitude, N(x / g.R), N(sqrt((g.R - x) * (g.R + x)) / g.R));
}

}  // namespace forceshade::reference
