// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-3p: three polygons, unshaded (thesis 4.4.3).

#include "reference/laws/polygon.h"

namespace forceshade::reference {

struct Bump3p {
  using Surface = ThreePolygons;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = nullptr;

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    return facet_of<ThreePolygons>(g, x, z);
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    const N size = magnitude<ThreePolygons>(facet, g, x, z);
    if (facet == Facet::plane || facet == Facet::top) return along(size, N(0.0), N(1.0));
    return along_face(facet, size, N(N(2.0) * g.h_prime / (g.w - g.w_prime)));
  }
};

}  // namespace forceshade::reference
