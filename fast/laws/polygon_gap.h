// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// H(x) - z, the penetration below the nominal height of a two- or three-polygon bump, first stage and exact stage.

#include "fast/laws/bump_geometry.h"
#include "fast/numbers/first_stage.h"

namespace forceshade::fast {

template <class Real>
struct Gap {
  Real value;            // mm, relative error at most 2^-51 unless unclear
  MaskOf<Real> unclear;  // so near the surface that `value` has lost too much, or its sign
};

// (height - slope·|x|) - z. The head of slope·|x| is exact and not above the height (but for 2^-28 of it, near the edge, where
// the difference is exact), so two subtractions give that difference's rounding error (Dekker); rounding - z is harmless, for
// it is relative to the gap. What remains is at most 2^-80·height, so a gap above 2^-27·height is good to 2^-51.
struct LinearGap {
  double height, height_tail;  // height - height_tail is below 2^-53·height
  Split slope;

  template <class Real>
  FORCESHADE_INLINE Gap<Real> at(Real ax, Real z) const {
    return gap(Real(height), Real(height_tail), Real(slope.head), Real(slope.tail), ax, z);
  }

  template <class Real>
  FORCESHADE_INLINE static Gap<Real> gap(Real height, Real height_tail, Real slope, Real slope_tail, Real ax, Real z) {
    const Real surface = multiply_subtract(slope, ax, height);
    const Real error = multiply_subtract(slope, ax, height - surface);
    const Real value = (surface - z) + (error + (height_tail - slope_tail * ax));
    return {value, absolute(value) < Real(0x1p-27) * height};
  }
};

inline LinearGap linear_gap(const DoubleDouble& height, const DoubleDouble& slope) noexcept {
  return {height.hi, height.lo, split(slope)};
}

// Two polygons: h - (2h/w)|x| - z for |x| <= w/2.
inline LinearGap two_polygon_gap(const BumpFace<DoubleDouble>& face, float width) noexcept {
  return linear_gap(face.tangent * DoubleDouble::exactly(0.5 * static_cast<double>(width)), face.tangent);
}

template <class N>
N side_gap(const BumpFace<N>& face, float width, float ax, float z) noexcept {
  // The difference is N's to take: in binary64 it would round where |x| is far below w.
  const N from_edge = N::exactly(0.5 * static_cast<double>(width)) - N::exactly(static_cast<double>(ax));
  return face.tangent * from_edge - N::exactly(static_cast<double>(z));
}

// At |x| = w/2 the height is 0, whatever the slope.
template <class N>
N at_foot(float z) noexcept {
  return N::exactly(-static_cast<double>(z));
}

// Three polygons: h′ - z on the top, tan θ·(w/2 - |x|) - z on the sides.
struct ThreePolygonGap {
  LinearGap top, side;

  template <class Real>
  FORCESHADE_INLINE Gap<Real> at(Real ax, Real z, MaskOf<Real> on_top) const {
    return LinearGap::gap(
        select(on_top, Real(top.height), Real(side.height)), select(on_top, Real(top.height_tail), Real(side.height_tail)),
        select(on_top, Real(0), Real(side.slope.head)), select(on_top, Real(0), Real(side.slope.tail)), ax, z);
  }
};

inline ThreePolygonGap three_polygon_gap(const ThreePolygons<DoubleDouble>& g, float width) noexcept {
  const DoubleDouble half = DoubleDouble::exactly(0.5 * static_cast<double>(width));
  return {linear_gap(g.height, DoubleDouble::exactly(0)), linear_gap(g.face.tangent * half, g.face.tangent)};
}

}  // namespace forceshade::fast
