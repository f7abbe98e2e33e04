// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the laws on this side, in the order of LawId.

#include "fast/laws/bump_1p.h"
#include "fast/laws/bump_1p_shaded.h"
#include "fast/laws/bump_2p.h"
#include "fast/laws/bump_2p_shaded.h"
#include "fast/laws/bump_3p.h"
#include "fast/laws/bump_3p_shaded.h"
#include "fast/laws/bump_cylinder.h"
#include "fast/laws/cylinder.h"
#include "fast/laws/wall.h"
#include "fast/numbers/first_stage.h"
#include "forceshade/law.h"

namespace forceshade::fast {

template <class... Definition>
struct LawList {
  static constexpr std::size_t kCount = sizeof...(Definition);
  static_assert((window_covers(doubt_window(Definition::kErrorBound), Definition::kErrorBound) && ...),
                "the window of the rounding test holds what the error bound of each law moves");
};

using Laws = LawList<Wall, Cylinder, BumpCylinder, Bump1p, Bump2p, Bump3p, Bump1pShaded, Bump2pShaded, Bump3pShaded>;
static_assert(Laws::kCount == kLaws.size(), "each law of include/forceshade/law.h has its definition here");

}  // namespace forceshade::fast
