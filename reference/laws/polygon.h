// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The nominal heights H(x) of the two- and three-polygon bumps and the facet a position is on (thesis 4.4.2, 4.4.3).

#include "reference/laws/force.h"

namespace forceshade::reference {

struct TwoPolygons {
  // On a side face: h(1 - 2|x|/w).
  template <class N>
  static N height(Facet, const BumpGeometry<N>& g, const N& x) {
    return g.h * (N(1.0) - N(2.0) * size_of(x) / g.w);
  }

  // x = 0 belongs to the right face.
  template <class N>
  static Facet face(const BumpGeometry<N>&, const N& x) {
    return x < N(0.0) ? Facet::left : Facet::right;
  }

  template <class N>
  static N height_at(const BumpGeometry<N>& g, const N& x) {
    return height(face(g, x), g, x);
  }
};

struct ThreePolygons {
  // h′ on the top, h′(w/2 - |x|)/(w/2 - w′/2) on a side face.
  template <class N>
  static N height(Facet facet, const BumpGeometry<N>& g, const N& x) {
    if (facet == Facet::top) return g.h_prime;
    return g.h_prime * (g.w - N(2.0) * size_of(x)) / (g.w - g.w_prime);
  }

  template <class N>
  static Facet face(const BumpGeometry<N>& g, const N& x) {
    if (N(2.0) * size_of(x) <= g.w_prime) return Facet::top;
    return x < N(0.0) ? Facet::left : Facet::right;
  }

  template <class N>
  static N height_at(const BumpGeometry<N>& g, const N& x) {
    return height(face(g, x), g, x);
  }
};

// The facet of a position in or out of contact with a nominal geometry on the plane z = 0.
template <class Polygons, class N>
Facet facet_of(const BumpGeometry<N>& g, const N& x, const N& z) {
  if (!is_within_width(g, x)) return z < N(0.0) ? Facet::plane : Facet::none;
  const Facet face = Polygons::face(g, x);
  return z < Polygons::height(face, g, x) ? face : Facet::none;
}

// K(H - z).
template <class Polygons, class N>
N magnitude(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
  const N height = facet == Facet::plane ? N(0.0) : Polygons::height(facet, g, x);
  return g.K * (height - z);
}

// The normal of a side face with slope 2·rise/run, as printed: (±slope, 1)/√(1 + slope²).
template <class N>
Force<N> along_face(Facet facet, const N& magnitude, const N& slope) {
  const N length = sqrt(N(1.0) + slope * slope);
  const N x = facet == Facet::left ? N(-slope) : slope;
  return along(magnitude, N(x / length), N(N(1.0) / length));
}

}  // namespace forceshade::reference
