// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edge of the flat top of a three-polygon bump, decided exactly.

#include <array>
#include <cmath>
#include <cstddef>

#include "fast/numbers/double_double.h"

namespace forceshade::fast {

// The sign of an exact sum of binary64 numbers: Shewchuk's expansion, whose last nonzero term outweighs the others.
template <std::size_t kCount>
inline int exact_sign(const std::array<double, kCount>& terms) noexcept {
  std::array<double, kCount> expansion{};
  for (std::size_t i = 0; i < kCount; ++i) {
    double carry = terms[i];
    for (std::size_t j = 0; j < i; ++j) {
      const TwoTerms s = two_sum(carry, expansion[j]);
      expansion[j] = s.lo;
      carry = s.hi;
    }
    expansion[i] = carry;
  }
  for (std::size_t i = kCount; i-- > 0;)
    if (expansion[i] != 0) return expansion[i] > 0 ? 1 : -1;
  return 0;
}

inline bool is_on_top(float candidate, float radius, float width) noexcept {
  const double c = static_cast<double>(candidate);
  const double R = static_cast<double>(radius);
  const TwoTerms cube = two_product(c * c, c);  // c·c, R·R have 48 bits: exact
  const TwoTerms scaled = two_product(R * R, c);
  const TwoTerms constant = two_product(R * R, 0.5 * static_cast<double>(width));
  return 2 * c <= R && exact_sign(std::array{4 * cube.lo, 4 * cube.hi, -2 * scaled.lo, -scaled.lo, -2 * scaled.hi, -scaled.hi,
                                             constant.lo, constant.hi}) >= 0;
}

// The largest binary32 c with c <= w′/2 exactly: 4c³ - 3cR² + (w/2)R² >= 0 and 2c <= R, decided in exact arithmetic, for
// equality does occur (w = 2R; R = 1, w = 1.375).
inline float largest_on_top(float radius, float width, const DoubleDouble& half_top) noexcept {
  // half_top is good to far more than a binary32, so one step either way is enough; the bound keeps a wrong one from hanging.
  float c = static_cast<float>(half_top.hi);
  for (int step = 0; step < 2 && !is_on_top(c, radius, width); ++step) c = std::nextafter(c, -HUGE_VALF);
  for (int step = 0; step < 2; ++step)
    if (const float next = std::nextafter(c, HUGE_VALF); is_on_top(next, radius, width)) c = next;
  return c;
}

}  // namespace forceshade::fast
