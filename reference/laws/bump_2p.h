// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-2p: two polygons, unshaded (thesis 4.4.2; x = 0 belongs to the right face).

#include "reference/laws/polygon.h"

namespace forceshade::reference {

struct Bump2p {
  using Surface = TwoPolygons;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = "cos(alpha/2) K/2 max(0, H(x) - z)^2";  // w/2 is the end of the domain

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    return facet_of<TwoPolygons>(g, x, z);
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    const N size = magnitude<TwoPolygons>(facet, g, x, z);
    if (facet == Facet::plane) return along(size, N(0.0), N(1.0));
    return along_face(facet, size, N(N(2.0) * g.h / g.w));
  }
};

}  // namespace forceshade::reference
