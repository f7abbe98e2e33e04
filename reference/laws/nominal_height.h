// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// H(x): where a law's force begins on the way down.

#include "forceshade/reference/laws/with_law.h"

namespace forceshade::reference {

// mm, for 2|x| <= w.
template <class N>
N nominal_height(LawId id, const BumpGeometry<N>& g, const N& x) {
  switch (id) {
    case LawId::cylinder:
    case LawId::bump_cylinder: return sqrt((g.R - x) * (g.R + x)) - g.d;
    case LawId::bump_2p:
    case LawId::bump_2p_shaded: return TwoPolygons::height(TwoPolygons::face(g, x), g, x);
    case LawId::bump_3p:
    case LawId::bump_3p_shaded: return ThreePolygons::height(ThreePolygons::face(g, x), g, x);
    case LawId::wall:
    case LawId::bump_1p:
    case LawId::bump_1p_shaded: return N(0.0);
  }
  return N(0.0);
}

}  // namespace forceshade::reference
