// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// wall: F = -K z ẑ for z < 0 (thesis 2.2.1, sign and condition corrected).

#include "reference/laws/force.h"

namespace forceshade::reference {

struct Wall {
  using Surface = LevelSurface;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = kPlanePotential;

  template <class N>
  static Facet facet(const BumpGeometry<N>&, const N&, const N& z) {
    return z < N(0.0) ? Facet::plane : Facet::none;
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N&, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    return along(N(g.K * -z), N(0.0), N(1.0));
  }
};

}  // namespace forceshade::reference
