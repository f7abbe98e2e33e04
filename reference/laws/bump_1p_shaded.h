// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-1p-shaded: H = 0; D is the cylinder's normal for 2|x| <= w, else ẑ (thesis 4.5).

#include "reference/laws/wall.h"

namespace forceshade::reference {

struct Bump1pShaded {
  using Surface = LevelSurface;
  static constexpr bool kIsShaded = true;
  static constexpr const char* kPotential = nullptr;

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    if (!(z < N(0.0))) return Facet::none;
    return is_within_width(g, x) ? Facet::top : Facet::plane;
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    const N magnitude = g.K * -z;
    if (facet == Facet::plane) return along(magnitude, N(0.0), N(1.0));
    return along_shaded(g, magnitude, x);
  }
};

}  // namespace forceshade::reference
