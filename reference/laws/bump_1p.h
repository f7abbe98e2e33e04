// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-1p: one polygon, unshaded (thesis 4.4.1): H = 0, D = ẑ.

#include "reference/laws/wall.h"

namespace forceshade::reference {

struct Bump1p {
  using Surface = LevelSurface;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = kPlanePotential;

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    return Wall::facet(g, x, z);
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    return Wall::force(facet, g, x, z);
  }
};

}  // namespace forceshade::reference
