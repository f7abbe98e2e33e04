// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder: F = K(R - ρ)·l/ρ for ρ < R, l = (x, z + d), ρ = ‖l‖ (thesis 2.2.2, sign and condition corrected); K R ẑ on the
// axis, where the direction does not exist.

#include "forceshade/fast/bump_geometry.h"
#include "forceshade/fast/first_stage.h"
#include "forceshade/fast/outcome.h"
#include "forceshade/vocabulary/law.h"

namespace forceshade::fast {

struct Cylinder {
  static constexpr double kErrorBound = 0x1p-48;  // at most 20·2^-53
  static constexpr std::size_t kWideLimbs = 32;
  template <class N>
  using Geometry = N;  // d
  template <class N>
  static N geometry(const Parameters& p) noexcept {
    return axis_depth<N>(p.radius, p.width);
  }

  double R, K;
  double half_width_squared;  // (w/2)², exact
  Split d;

  Cylinder(const Parameters& p, const DoubleDouble& depth) noexcept
      : R(static_cast<double>(p.radius)),
        K(static_cast<double>(p.stiffness)),
        half_width_squared(0.25 * static_cast<double>(p.width) * static_cast<double>(p.width)),
        d(split(depth)) {}

  // R - ρ = v/(R + ρ) with v = R² - ρ² = (w/2)² - x² - z² - 2zd: every term but the tail of d is exact in binary64 and the
  // sum keeps its rounding errors, so nothing cancels near the surface until v is below 2^-26 of its terms. The tail of d
  // is good to 2^-82·d, enough for l until |l| is below 2^-26·d.
  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real xx = x * x;
    const Real two_z = z + z;
    const Real zd = two_z * Real(d.head);
    const auto a = exact_sum(Real(half_width_squared), -xx);
    const auto b = exact_sum(z * z, zd);
    const auto c = exact_sum(a.value, -b.value);
    const Real v = c.value + (((a.error - b.error) + c.error) - two_z * Real(d.tail));
    const Real l = (z + Real(d.head)) + Real(d.tail);
    const Real rho = square_root(xx + l * l);
    const Real scale = Real(K) * v / ((Real(R) + rho) * rho);
    const MaskOf<Real> v_is_clear = absolute(v) >= Real(0x1p-26) * (Real(half_width_squared) + absolute(zd));
    const MaskOf<Real> l_is_clear = absolute(l) > Real(0x1p-26 * d.head);
    return {scale * x, scale * l, v > Real(0), !(v_is_clear & l_is_clear)};
  }

  template <class N>
  static Outcome<N> exact(const Parameters& p, const N& depth, float x, float z) noexcept {
    const N R = N::exactly(static_cast<double>(p.radius));
    const N K = N::exactly(static_cast<double>(p.stiffness));
    const N half = N::exactly(0.5 * static_cast<double>(p.width));
    const N X = N::exactly(static_cast<double>(x));
    const N Z = N::exactly(static_cast<double>(z));
    const N l = Z + depth;
    const Sign beside_axis = x != 0 ? Sign::positive : sign(l);
    if (beside_axis == Sign::unknown) return {Sign::unknown, R, R};
    if (beside_axis == Sign::zero) return {Sign::positive, N::exactly(0), K * R};
    const N v = (half - X) * (half + X) - Z * (Z + depth + depth);
    const N rho = square_root(X * X + l * l);
    const N scale = K * v / ((R + rho) * rho);
    return {sign(v), scale * X, scale * l};
  }
};

}  // namespace forceshade::fast
