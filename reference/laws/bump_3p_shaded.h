// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-3p-shaded: the magnitude of bump-3p, the cylinder's normal for 2|x| <= w, else ẑ (thesis 4.5).

#include "reference/laws/polygon.h"

namespace forceshade::reference {

struct Bump3pShaded {
  using Surface = ThreePolygons;
  static constexpr bool kIsShaded = true;
  static constexpr const char* kPotential = nullptr;

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    return facet_of<ThreePolygons>(g, x, z);
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    const N size = magnitude<ThreePolygons>(facet, g, x, z);
    if (facet == Facet::plane) return along(size, N(0.0), N(1.0));
    return along_shaded(g, size, x);
  }
};

}  // namespace forceshade::reference
