// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Limits of damping where several surfaces are touched.

#include <algorithm>

#include "forceshade/damping.h"

namespace forceshade::fast {

// The larger B and the larger B_t.
inline damping::Limits larger_limits(const damping::Limits& a, const damping::Limits& b) noexcept {
  return {std::max(a.damping, b.damping), std::max(a.drag, b.drag)};
}

}  // namespace forceshade::fast
