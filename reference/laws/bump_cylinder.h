// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-cylinder: F = F_cylinder + F_wall, each where its own penetration is positive (thesis 4.3).

#include "reference/laws/cylinder.h"
#include "reference/laws/wall.h"

namespace forceshade::reference {

struct BumpCylinder {
  using Surface = RoundSurface;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = "K/2 max(0, R - sqrt(x^2 + (z + d)^2))^2 + K/2 max(0, -z)^2";

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    const Facet cylinder = Cylinder::facet(g, x, z);
    const Facet wall = Wall::facet(g, x, z);
    if (cylinder == Facet::none) return wall;
    // The axis is below the plane, or on it (w = 2R), where the wall does not act.
    if (cylinder == Facet::axis) return cylinder;
    return wall == Facet::none ? cylinder : Facet::cylinder_and_plane;
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none || facet == Facet::plane) return Wall::force(facet, g, x, z);
    Force<N> sum = Cylinder::force(facet, g, x, z);
    if (facet == Facet::cylinder) return sum;
    // On the axis z = -d <= 0: the wall's push is K d, zero where the axis lies on the plane.
    sum.z = sum.z + g.K * -z;
    return sum;
  }
};

}  // namespace forceshade::reference
