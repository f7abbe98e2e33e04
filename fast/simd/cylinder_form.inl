// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The batch's form of the cylinder, alone and in the plane (fast/simd/form.inl).
//
// The force is K·t·(x, l) with t = (R - ρ)/ρ, the positive root of t(2 + t)·ρ² = v, where v = R² - ρ². Binary32 gives t to
// 10·2^-24, and one step of Newton in binary64, t + (v - t(2 + t)·ρ²)·(1 + t)/(2R²), to 80·2^-48: correct rounding is left open
// for one position in 10⁵. v = (w/2 - |x|)(w/2 + |x|) - z(z + 2d) is a difference of two products of exact factors (Kahan).
// Errors: cylinder_form.g.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "fast/laws/bump_cylinder.h"
#include "fast/laws/cylinder.h"
#include "fast/simd/form.inl"

namespace forceshade::fast {
namespace {

// The first pass keeps these of as many positions as a vector of binary32 has lanes. They lie side by side: the arrays that
// each would have otherwise are as long as a page, and a processor takes a load for one of what it has just stored at that
// place of another page.
struct alignas(64) KeptPositions {
  double x[Floats::kLanes], z[Floats::kLanes], v[Floats::kLanes];
  float t[Floats::kLanes];
};

template <class Definition>
struct CylinderForm {
  static constexpr bool kHasPlane = std::is_same_v<Definition, BumpCylinder>;
  static constexpr double kErrorBound = 0x14p-46;
  static constexpr int kWindow = doubt_window(kErrorBound);

  Floats R, R_squared_head, R_squared_tail, axis, least_rho_squared;  // R² = head + tail
  Two R_squared, K, K_over_2R_squared, half_width, d_head, d_tail, twice_d_head, twice_d_tail;
  float least_coordinate;  // below it, w/2 ± |x| and z + 2d may have to be rounded
  double least_distance;   // of v

  explicit CylinderForm(const Definition& law) : CylinderForm(law, std::sqrt((law.anchored - law.anchor) + law.rest)) {}

  FORCESHADE_INLINE Two v(Watch& watch, const Two& x, const Two& z) const {
    const Two factor = z + twice_d_head, product = z * factor, error = fused_less(z, factor, product);
    const Two v = fused_less(half_width - x, half_width + x, product) - fused_add(z, twice_d_tail, error);
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
  FORCESHADE_INLINE Floats rho_squared(Floats v) const { return (R_squared_head - v) + R_squared_tail; }
  FORCESHADE_INLINE Floats rough_t(Floats v, Floats rho_squared) const {
    return v / (R * square_root(rho_squared) + rho_squared);
  }

  // K·t after the step, whose derivative K/(2Rρ) is K(1 + t)/(2R²); 0 outside.
  FORCESHADE_INLINE Two scale(const Two& t, const Two& v) const {
    const Two derivative = fused_add(t, K_over_2R_squared, K_over_2R_squared);
    const Two missing = fused_subtract_from(t * (R_squared - v), t + Two(2), v);
    return larger(fused_add(missing, derivative, t * K), Two(0));
  }
  // + 0 turns -0 into +0.
  FORCESHADE_INLINE Components components(const Two& scale, const Two& x, const Two& z) const {
    const Two l = (z + d_head) + d_tail;
    Two from_plane(0);
    if constexpr (kHasPlane) from_plane = larger(-K * z, Two(0));
    return {fused_add(scale, x, Two(0)), fused_add(scale, l, from_plane)};
  }

 private:
  CylinderForm(const Definition& law, double half)  // half: w/2, for (w/2)² is exact
      : R(law.R),
        R_squared_head(law.R * law.R),
        R_squared_tail(law.R * law.R - static_cast<double>(static_cast<float>(law.R * law.R))),
        axis(law.axis),
        least_rho_squared(0.16 * law.R * law.R),
        R_squared(law.R * law.R),
        K(law.K),
        K_over_2R_squared(0.5 * law.K / (law.R * law.R)),
        half_width(half),
        d_head(law.d.head),
        d_tail(law.d.tail),
        twice_d_head(2 * law.d.head),
        twice_d_tail(2 * law.d.tail),
        least_coordinate(std::max(kPositionQuantum, static_cast<float>(0x1p-27 * std::max(half, law.d.head)))),
        least_distance(0x1p-24 * law.R * law.R) {}
};

// Has the processor fetch the line that is read or written a block later. It has to follow the loads of this block: before them
// it misleads the processor's own prefetching. The address may lie behind the array, where it does nothing.
inline void fetch_for_next_block(const float* at) {
  __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(at) + kBlock * sizeof(float)));
}

template <class Definition>
bool answer(const CylinderForm<Definition>& cylinder, std::size_t count, const float* x, const float* z, float* fx, float* fz) {
  using Form = CylinderForm<Definition>;
  const Form form = cylinder;  // a copy that the stores below cannot alias
  KeptPositions kept_positions[kBlock / Floats::kLanes];
  const auto kept_at = [&](std::size_t i)
                           FORCESHADE_INLINE_BODY -> KeptPositions& { return kept_positions[i / Floats::kLanes]; };
  Watch watch;
  staggered(
      count,
      [&](std::size_t i) FORCESHADE_INLINE_BODY {
        watch.coordinates(absolute(Floats::load(x + i)), absolute(Floats::load(z + i)));
        const Two at_x = Two::load(x + i), at_z = Two::load(z + i), v = form.v(watch, at_x, at_z);
        fetch_for_next_block(x + i);
        fetch_for_next_block(z + i);
        at_x.store(kept_at(i).x);
        at_z.store(kept_at(i).z);
        v.store(kept_at(i).v);
        return v;
      },
      [&](std::size_t i, const Two& wide_v) FORCESHADE_INLINE_BODY {
        const Floats v = rounded(wide_v), rho_squared = form.rho_squared(v);
        watch.doubt(form.is_in_doubt(v, rho_squared, Floats::load(z + i)));
        form.rough_t(v, rho_squared).store(kept_at(i).t);
      });
  staggered(
      count, [&](std::size_t i) FORCESHADE_INLINE_BODY { return form.scale(Two::load(kept_at(i).t), Two::load(kept_at(i).v)); },
      [&](std::size_t i, const Two& scale) FORCESHADE_INLINE_BODY {
        fetch_for_next_block(fx + i);
        fetch_for_next_block(fz + i);
        const Components force = form.components(scale, Two::load(kept_at(i).x), Two::load(kept_at(i).z));
        rounded<Form::kWindow>(force.x, watch).store(fx + i);
        rounded<Form::kWindow>(force.z, watch).store(fz + i);
      });
  return watch.is_free_of_hazards<Form::kWindow>(form.least_coordinate, form.least_distance);
}

}  // namespace
}  // namespace forceshade::fast
