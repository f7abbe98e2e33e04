// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Evaluates a law: first the facet (which formula holds at a position: decisions), then the force on it (values).

#include "reference/laws/bump_geometry.h"

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

// The surfaces z = H(x) where the forces of laws begin on the way down. height_at: H(x) in mm, for 2|x| <= w.
struct LevelSurface {
  template <class N>
  static N height_at(const BumpGeometry<N>&, const N&) {
    return N(0.0);
  }
};
struct RoundSurface {
  template <class N>
  static N height_at(const BumpGeometry<N>& g, const N& x) {
    return sqrt((g.R - x) * (g.R + x)) - g.d;
  }
};

// Potentials in words; a law's is null where no parameters give it one.
inline constexpr const char kPlanePotential[] = "K/2 max(0, -z)^2";
inline constexpr const char kCylinderPotential[] = "K/2 max(0, R - sqrt(x^2 + (z + d)^2))^2";

// The direction of force shading: the cylinder's normal above x, (x/R, √(R² - x²)/R).
template <class N>
Force<N> along_shaded(const BumpGeometry<N>& g, const N& magnitude, const N& x) {
  return along(magnitude, N(x / g.R), N(sqrt((g.R - x) * (g.R + x)) / g.R));
}

}  // namespace forceshade::reference
