// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The domain and the quantum of positions, as the fast path applies them. reference/ states both again: rule 2, CONTRIBUTING.

#include <array>
#include <cstdint>

#include "fast/numbers/inline.h"

namespace forceshade::fast {

inline constexpr float kLargestCoordinate = 1e4F;    // mm
inline constexpr float kPositionQuantum = 0x1p-30F;  // mm: a smaller coordinate is read as 0

// False for NaN.
FORCESHADE_INLINE bool in_domain(float coordinate) {
  return __builtin_fabsf(coordinate) <= kLargestCoordinate;
}

// True if the coordinate is in the domain and as quantised already. Integers decide, which leave the floating-point units
// free.
FORCESHADE_INLINE bool is_plain(float coordinate) {
  constexpr auto kLeast = __builtin_bit_cast(std::uint32_t, kPositionQuantum);
  constexpr auto kMost = __builtin_bit_cast(std::uint32_t, kLargestCoordinate);
  const std::uint32_t size = __builtin_bit_cast(std::uint32_t, coordinate) & INT32_MAX;
  return size - kLeast <= kMost - kLeast || size == 0;
}

FORCESHADE_INLINE float quantised(float coordinate) {
  return __builtin_fabsf(coordinate) >= kPositionQuantum ? coordinate : 0.0F;
}

// The same of a position.
FORCESHADE_INLINE bool in_domain(const std::array<float, 3>& position) {
  return in_domain(position[0]) && in_domain(position[1]) && in_domain(position[2]);
}
FORCESHADE_INLINE std::array<float, 3> quantised(const std::array<float, 3>& position) {
  return {quantised(position[0]), quantised(position[1]), quantised(position[2])};
}

}  // namespace forceshade::fast
