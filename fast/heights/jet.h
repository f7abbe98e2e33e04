// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map at a point: its height and its gradient, in Ball arithmetic (fast/numbers/ball.h).

#include "fast/domain.h"
#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/double_double.h"
#include "fast/numbers/double_with_error.h"
#include "fast/numbers/row.h"
#include "forceshade/height_map.h"

namespace forceshade::fast {

template <class N>
struct Jet {
  N U;                  // mm
  N Ux, Uy;             // mm/mm
  bool decided = true;  // false: N cannot decide on which side of a kink the point lies, and the rest means nothing

  FORCESHADE_INLINE friend Jet operator+(const Jet& a, const Jet& b) noexcept {
    return {a.U + b.U, a.Ux + b.Ux, a.Uy + b.Uy, a.decided && b.decided};
  }
  FORCESHADE_INLINE Jet operator-() const noexcept { return {-U, -Ux, -Uy, decided}; }
};

template <class N>
Jet<N> flat() noexcept {
  return {N::exactly(0), N::exactly(0), N::exactly(0)};
}
template <class N>
Jet<N> undecided() noexcept {
  return {N::exactly(0), N::exactly(0), N::exactly(0), false};
}

// A position in the plane, quantised: two binary32 numbers, mm. In one register: written apart and read together, they would
// have to be waited for.
struct Place {
  Pair64 coordinates;

  FORCESHADE_INLINE Place(float x, float y) noexcept : coordinates{static_cast<double>(x), static_cast<double>(y)} {}
  FORCESHADE_INLINE double x() const noexcept { return coordinates[0]; }
  FORCESHADE_INLINE double y() const noexcept { return coordinates[1]; }
};

template <class N>
N difference(double a, float b) noexcept {
  return N::exactly(a) - N::exactly(static_cast<double>(b));
}

// The side of a rim on which a point lies, X beside the centre of a disk; on the rim the side with larger x decides.
enum class Side { inside, outside, unknown };
template <class N>
Side side_of_rim(const N& radius_squared_less_rho_squared, bool is_left_of_centre) noexcept {
  switch (sign(radius_squared_less_rho_squared)) {
    case Sign::positive: return Side::inside;
    case Sign::negative: return Side::outside;
    case Sign::zero: return is_left_of_centre ? Side::inside : Side::outside;
    case Sign::unknown: break;
  }
  return Side::unknown;
}

}  // namespace forceshade::fast
