// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Limits of damping where several surfaces are touched. fast/ states it again: rule 2, CONTRIBUTING.

#include "forceshade/damping.h"

namespace forceshade::reference {

// B and B_t become at least those of the other surface.
inline void enlarge(damping::Limits& limits, const damping::Limits& by) {
  if (limits.damping < by.damping) limits.damping = by.damping;
  if (limits.drag < by.drag) limits.drag = by.drag;
}

}  // namespace forceshade::reference
