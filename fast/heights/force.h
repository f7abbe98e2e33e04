// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Computes the force from a height map's jet, in binary64 with a bound.

#include "fast/heights/jet.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {

// Bound of the roundings below, relative to each component: force.g.
inline constexpr double kHeightForceError = 0x1.4p-50;

struct RoundedComponent {
  float value;  // N
  bool is_sure;
};

struct HeightForce {
  float x, y, z;  // N
  Sign contact;   // unknown: binary64 cannot decide it, or not the rounding
};

// Minus the force of a gap (mm) over slopes, along x and y, and the force up: K·gap·(U_x, U_y, 1)/n, n = √(1 + U_x² + U_y²), or
// without n. Real: binary64 or a pack of them.
template <class Real>
struct GapForce {
  Real x, y, up;  // N
};
template <class Real>
FORCESHADE_INLINE GapForce<Real> gap_force(Real gap, Real Ux, Real Uy, height::Mode mode, Real K) noexcept {
  Real M = K * gap;
  if (mode != height::Mode::conservative) M = M / square_root(Real(1) + (Ux * Ux + Uy * Uy));
  return {M * Ux, M * Uy, M};
}

// U: of the surface that the depth is measured from; K: N/mm; z: mm.
//
// With M = K·gap/n, n = √(1 + U_x² + U_y²), e the errors of the jet and primes for exact numbers: |n - n'| <= e_x + e_y, for a
// length changes by no more than its vector, so |M - M'| <= K·e_U/n' + M|n - n'|/n' <= e_M = K·e_U + M(e_x + e_y), and
// |M·U_x - M'·U_x'| <= e_M(|U_x| + e_x) + M·e_x. kSlack covers the roundings of these bounds; 2^-48 would.
FORCESHADE_INLINE HeightForce height_force(const Jet<DoubleWithError>& map, height::Mode mode, double K, double z) noexcept {
  constexpr double kSlack = 1 + 0x1p-20;
  const double gap = map.U.value - z, gap_error = map.U.error;
  if (!map.decided) return {0, 0, 0, Sign::unknown};
  if (!(gap > kSlack * gap_error)) return {0, 0, 0, gap <= -kSlack * gap_error ? Sign::negative : Sign::unknown};
  const double Ux = map.Ux.value, Uy = map.Uy.value;
  const GapForce<double> of_jet = gap_force(gap, Ux, Uy, mode, K);
  const double M = of_jet.up;
  double error = K * gap_error;
  if (mode != height::Mode::conservative) error = error + M * (map.Ux.error + map.Uy.error);
  // Over a flat place all is exact as often as not, ties included, which no error bound could distinguish from their
  // neighbours.
  const bool is_exact = Ux == 0 && Uy == 0 && gap_error + map.Ux.error + map.Uy.error == 0 &&
                        two_sum(map.U.value, -z).lo == 0 && two_product(K, gap).lo == 0;
  error = is_exact ? 0 : kSlack * error + kHeightForceError * M;
  const auto rounded = [&](double value, const DoubleWithError& slope) -> RoundedComponent {
    const double reach = kSlack * (error * (__builtin_fabs(slope.value) + slope.error) + M * slope.error);
    const auto low = static_cast<float>(value - reach), high = static_cast<float>(value + reach);
    return {low + 0.0F, low == high};  // -0 becomes +0
  };
  const RoundedComponent x = rounded(-of_jet.x, map.Ux), y = rounded(-of_jet.y, map.Uy), up = rounded(M, {-1, 0});
  return {x.value, y.value, up.value, x.is_sure && y.is_sure && up.is_sure ? Sign::positive : Sign::unknown};
}

// Sizes of gap and slopes from which on their errors are small beside them.
inline constexpr double kErrorBudgetShare = 0x1p-35;
struct CertaintyThresholds {
  double gap = HUGE_VAL, Ux = HUGE_VAL, Uy = HUGE_VAL;
};

// The force of a gap (U - z, mm) where their errors are small beside gap and slopes: then each component is good to 2^-33, for
// those of gap, n and slope add up to three times 2^-35, and roundings to kHeightForceError. Unknown elsewhere, and next to
// ties.
FORCESHADE_INLINE HeightForce height_force(double gap, double Ux, double Uy, const CertaintyThresholds& sure, height::Mode mode,
                                           double K) noexcept {
  constexpr int kWindow = doubt_window(4 * kErrorBudgetShare);
  static_assert(window_covers(kWindow, 4 * kErrorBudgetShare));
  if (gap <= -sure.gap) return {0, 0, 0, Sign::negative};
  const auto [x, y, M] = gap_force(gap, Ux, Uy, mode, K);
  const bool is_sure = gap >= sure.gap && __builtin_fabs(Ux) >= sure.Ux && __builtin_fabs(Uy) >= sure.Uy &&
                       !rounding_is_in_doubt<kWindow>(x) && !rounding_is_in_doubt<kWindow>(y) &&
                       !rounding_is_in_doubt<kWindow>(M);
  return {0.0F - static_cast<float>(x), 0.0F - static_cast<float>(y), static_cast<float>(M),  // never -0
          is_sure ? Sign::positive : Sign::unknown};
}

}  // namespace forceshade::fast
