// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder: F = K(R - ρ)·l/ρ for ρ < R, l = (x, z + d), ρ = ‖l‖ (thesis 2.2.2, sign and condition corrected); K R ẑ on the
// axis, where the direction does not exist.

#include "fast/laws/bump_geometry.h"
#include "fast/laws/outcome.h"
#include "fast/numbers/first_stage.h"
#include "forceshade/law.h"

namespace forceshade::fast {

struct Cylinder {
  static constexpr double kErrorBound = 0x1.2p-49;  // 18·2^-53; cylinder.g proves 16.6
  static constexpr std::size_t kWideLimbs = 32;
  static constexpr int kSeparation = 946;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = N;  // d
  template <class N>
  static N geometry(const Parameters& p) noexcept {
    return axis_depth<N>(p.radius, p.width);
  }

  double R, K;
  double anchor;          // 8R², exact
  double anchored, rest;  // anchored + rest == 8R² + (w/2)² exactly
  Split d;
  double axis;  // the binary32 nearest to -d

  Cylinder(const Parameters& p, const DoubleDouble& depth) noexcept
      : R(static_cast<double>(p.radius)),
        K(static_cast<double>(p.stiffness)),
        anchor(8 * R * R),
        d(split(depth)),
        axis(-static_cast<double>(static_cast<float>(depth.hi))) {
    const double half = 0.5 * static_cast<double>(p.width);
    const TwoTerms sum = fast_two_sum(anchor, half * half);
    anchored = sum.hi;
    rest = sum.lo;
  }

  // R - ρ = v/(R + ρ) with v = R² - ρ² = (((8R² + (w/2)²) - x²) - z²) - 8R² - 2zd. Starting from 8R², which is larger than
  // x² + z² wherever v may be positive, makes each sum's rounding error two more subtractions (Dekker), not five (Knuth);
  // - 8R² is exact, and rounding - 2zd is harmless, for it is relative to v. What is left out is below 2^-80·|2zd| + 2^-100·R²,
  // so v is good to 4·2^-53 until it is below 2^-26·|2zd| + 2^-47·R². Farther out than 8R² v is far from 0.
  // l is good to 3·2^-53 but at the one z next to -d: the tail of d is good to 2^-82·d, and any other z leaves |l| > 2^-26·d.
  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    FirstStage<Real> force = off_axis(x, z);
    force.doubt = force.doubt | (z == Real(axis));
    return force;
  }

  // The same as first_stage, but at the one z next to -d.
  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> off_axis(Real x, Real z) const {
    const Real a = multiply_subtract(x, x, Real(anchored));
    const Real a_error = multiply_subtract(x, x, Real(anchored) - a);
    const Real b = multiply_subtract(z, z, a);
    const Real b_error = multiply_subtract(z, z, a - b);
    const Real low = (a_error + b_error) + (Real(rest) - z * Real(2 * d.tail));
    const Real v = multiply_subtract(z, Real(2 * d.head), b - Real(anchor)) + low;
    const Real l = (z + Real(d.head)) + Real(d.tail);
    const Real rho = square_root(multiply_add(x, x, l * l));
    const Real scale = larger(Real(K) * v, Real(0)) / ((Real(R) + rho) * rho);
    const Real least_v = multiply_add(absolute(z), Real(0x1p-25 * d.head), Real(0x1p-47 * R * R));
    return {scale * x, scale * l, v > Real(0), absolute(v) < least_v};
  }

  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) noexcept {
    const N& depth = geometry();
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
