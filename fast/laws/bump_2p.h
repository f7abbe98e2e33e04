// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-2p: two polygons, unshaded (thesis 4.4.2): K(H - z) along (±sin α/2, cos α/2) for 2|x| <= w, x = 0 to the right.

#include "fast/laws/outcome.h"
#include "fast/laws/polygon_gap.h"
#include "forceshade/law.h"

namespace forceshade::fast {

struct Bump2p {
  static constexpr double kErrorBound = 0x1p-50;  // gap 2^-51, product and constant 2·2^-53
  static constexpr std::size_t kWideLimbs = 32;
  static constexpr int kSeparation = 1063;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = BumpFace<N>;
  template <class N>
  static BumpFace<N> geometry(const Parameters& p) noexcept {
    return two_polygon_face<N>(p.radius, p.width);
  }

  LinearGap gap;
  double K, K_sine, K_cosine;  // N/mm
  double half_width;           // mm

  Bump2p(const Parameters& p, const BumpFace<DoubleDouble>& face) noexcept
      : gap(two_polygon_gap(face, p.width)),
        K(static_cast<double>(p.stiffness)),
        K_sine((DoubleDouble::exactly(K) * face.sine).hi),
        K_cosine((DoubleDouble::exactly(K) * face.cosine).hi),
        half_width(0.5 * static_cast<double>(p.width)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real ax = absolute(x);
    const MaskOf<Real> on_side = ax <= Real(half_width);
    const auto bump = gap.at(ax, z);
    const Real value = larger(select(on_side, bump.value, -z), Real(0));
    const Real slope = select(on_side, select(x < Real(0), Real(-K_sine), Real(K_sine)), Real(0));
    const MaskOf<Real> doubt = on_side & bump.unclear;
    return {value * slope, value * select(on_side, Real(K_cosine), Real(K)), value > Real(0), doubt};
  }

  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) noexcept {
    const float ax = __builtin_fabsf(x);
    if (2 * ax > p.width) return on_plane<N>(p.stiffness, z);
    const BumpFace<N>& face = geometry();
    return along(side_gap(face, p.width, ax, z), p.stiffness, x < 0 ? -face.sine : face.sine, face.cosine);
  }
};

}  // namespace forceshade::fast
