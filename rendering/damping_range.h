// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The range of B and B_t, of the fast side and of materials. reference/damping.cpp states it again: rule 2, CONTRIBUTING.

namespace forceshade {

inline constexpr float kLeastDamping = 0x1p-20F, kMostDamping = 16;  // N·s/mm, of those that are not 0

inline bool is_damping(float damping) {
  return damping == 0 || (damping >= kLeastDamping && damping <= kMostDamping);
}

}  // namespace forceshade
