// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the laws on this side.

#include "reference/laws/bump_1p.h"
#include "reference/laws/bump_1p_shaded.h"
#include "reference/laws/bump_2p.h"
#include "reference/laws/bump_2p_shaded.h"
#include "reference/laws/bump_3p.h"
#include "reference/laws/bump_3p_shaded.h"
#include "reference/laws/bump_cylinder.h"
#include "reference/laws/cylinder.h"
#include "reference/laws/wall.h"

namespace forceshade::reference {

// f(law), law being an object of the id's struct.
template <class F>
auto with_law(LawId id, const F& f) {
  switch (id) {
    case LawId::wall: return f(Wall{});
    case LawId::cylinder: return f(Cylinder{});
    case LawId::bump_cylinder: return f(BumpCylinder{});
    case LawId::bump_1p: return f(Bump1p{});
    case LawId::bump_2p: return f(Bump2p{});
    case LawId::bump_3p: return f(Bump3p{});
    case LawId::bump_1p_shaded: return f(Bump1pShaded{});
    case LawId::bump_2p_shaded: return f(Bump2pShaded{});
    case LawId::bump_3p_shaded: return f(Bump3pShaded{});
  }
  return f(Wall{});
}

}  // namespace forceshade::reference
