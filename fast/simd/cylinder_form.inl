// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The batch's form of the cylinder, alone and in the plane (fast/simd/form.inl).
//
// The force is K·t·(x, l) with t = (R - ρ)/ρ, the positive root of t(2 + t)·ρ² = v, where v = R² - ρ². A root and a quotient in
// binary32 give t to 5.5·2^-24, and one step of Newton in binary64, t + (v - t(2 + t)·ρ²)/(2Rρ), to 36·2^-48: correct rounding
// is left open for one position in 10⁵. v = (w/2 - |x|)(w/2 + |x|) - z(z + 2d) is a difference of two products of exact factors
// (Kahan). Errors: cylinder_form.g.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "fast/laws/bump_cylinder.h"
#include "fast/laws/cylinder.h"
#include "fast/simd/form.inl"

namespace forceshade::fast {
namespace {

// t, and the derivative of the step, K/(2Rρ).
struct RoughStep {
  Floats t, derivative;
};

template <class Definition>
struct CylinderForm {
  static constexpr bool kHasPlane = std::is_same_v<Definition, BumpCylinder>;
  static constexpr double kErrorBound = 0x9p-46;
  static constexpr int kWindow = doubt_window(kErrorBound);

  Floats R, half_K, axis, least_rho_squared;
  Two R_squared, K, half_width, d_head, d_tail, twice_d_head, twice_d_tail;
  float least_coordinate;  // below it, w/2 ± |x| and z + 2d may have to be rounded
  double least_distance;   // of v

  explicit CylinderForm(const Definition& law) : CylinderForm(law, std::sqrt((law.anchored - law.anchor) + law.rest)) {}

  FORCESHADE_INLINE Two v(Watch& watch, const float* x, const float* z) const {
    watch.coordinates(absolute(Floats::load(x)));
    watch.coordinates(absolute(Floats::load(z)));
    const Two at_x = Two::load(x), at_z = Two::load(z), factor = at_z + twice_d_head;
    const Two product = at_z * factor, error = fused_less(at_z, factor, product);
    const Two v = fused_less(half_width - at_x, half_width + at_x, product) - fused_add(at_z, twice_d_tail, error);
    watch.distance(v.first, v.second);
    return v;
  }

  // Near the axis, where ρ² = R² - v is known too roughly; where l is; in the plane, where the two forces oppose and may
  // cancel.
  FORCESHADE_INLINE Floats::Mask is_in_doubt(Floats v, Floats rho_squared, Floats z) const {
    const Floats::Mask is_near_axis = rho_squared < least_rho_squared;
    if constexpr (kHasPlane) return is_near_axis | ((v > Floats(0.0F)) & (z <= axis));
    return is_near_axis | (z == axis);
  }
  FORCESHADE_INLINE RoughStep rough_step(Floats v, Floats rho_squared) const {
    const Floats R_rho = R * square_root(rho_squared);
    return {v / (R_rho + rho_squared), half_K / R_rho};
  }

  // K·t after the step; 0 outside.
  FORCESHADE_INLINE Two scale(const Two& t, const Two& derivative, const Two& v) const {
    const Two missing = fused_subtract_from(t * (R_squared - v), t + Two(2), v);
    return larger(fused_add(missing, derivative, t * K), Two(0));
  }
  // + 0 turns -0 into +0.
  FORCESHADE_INLINE Components components(const Two& scale, const float* x, const float* z) const {
    const Two at_z = Two::load(z), l = (at_z + d_head) + d_tail;
    Two from_plane(0);
    if constexpr (kHasPlane) from_plane = larger(-K * at_z, Two(0));
    return {fused_add(scale, Two::load(x), Two(0)), fused_add(scale, l, from_plane)};
  }

 private:
  CylinderForm(const Definition& law, double half)  // half: w/2, for (w/2)² is exact
      : R(law.R),
        half_K(0.5 * law.K),
        axis(law.axis),
        least_rho_squared(law.R * law.R / 16),
        R_squared(law.R * law.R),
        K(law.K),
        half_width(half),
        d_head(law.d.head),
        d_tail(law.d.tail),
        twice_d_head(2 * law.d.head),
        twice_d_tail(2 * law.d.tail),
        least_coordinate(std::max(kPositionQuantum, static_cast<float>(0x1p-27 * std::max(half, law.d.head)))),
        least_distance(0x1p-24 * law.R * law.R) {}
};

template <class Definition>
bool answer(const CylinderForm<Definition>& cylinder, std::size_t count, const float* x, const float* z, float* fx, float* fz) {
  using Form = CylinderForm<Definition>;
  const Form form = cylinder;  // a copy that the stores below cannot alias
  alignas(64) double kept_v[kBlock];
  alignas(64) float kept_t[kBlock], kept_derivative[kBlock];
  Watch watch;
  staggered(
      count, [&](std::size_t i) FORCESHADE_INLINE_BODY { return form.v(watch, x + i, z + i); },
      [&](std::size_t i, const Two& wide_v) FORCESHADE_INLINE_BODY {
        const Floats v = rounded(wide_v), rho_squared = rounded(form.R_squared - wide_v);
        const RoughStep rough = form.rough_step(v, rho_squared);
        watch.doubt(form.is_in_doubt(v, rho_squared, Floats::load(z + i)));
        wide_v.store(kept_v + i);
        rough.t.store(kept_t + i);
        rough.derivative.store(kept_derivative + i);
      });
  staggered(
      count,
      [&](std::size_t i) FORCESHADE_INLINE_BODY {
        return form.scale(Two::load(kept_t + i), Two::load(kept_derivative + i), Two::load(kept_v + i));
      },
      [&](std::size_t i, const Two& scale) FORCESHADE_INLINE_BODY {
        const Components force = form.components(scale, x + i, z + i);
        rounded<Form::kWindow>(force.x, watch).store(fx + i);
        rounded<Form::kWindow>(force.z, watch).store(fz + i);
      });
  return watch.is_free_of_hazards<Form::kWindow>(form.least_coordinate, form.least_distance);
}

}  // namespace
}  // namespace forceshade::fast
