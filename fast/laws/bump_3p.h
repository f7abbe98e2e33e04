// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-3p: three polygons, unshaded (thesis 4.4.3): K(H - z) along ẑ on the flat top, (±sin θ, cos θ) on the sides.

#include "fast/laws/outcome.h"
#include "fast/laws/polygon_gap.h"
#include "fast/laws/top_edge.h"
#include "forceshade/law.h"

namespace forceshade::fast {

struct Bump3p {
  static constexpr double kErrorBound = 0x1p-50;  // gap 2^-51, product and constant 2·2^-53
  static constexpr std::size_t kWideLimbs = 64;
  static constexpr int kSeparation = 2102;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = ThreePolygons<N>;
  template <class N>
  static ThreePolygons<N> geometry(const Parameters& p) noexcept {
    return three_polygons<N>(p.radius, p.width);
  }

  ThreePolygonGap gap;
  double K, K_sine, K_cosine;  // N/mm
  double half_width;           // mm
  float half_top;              // mm: the largest binary32 <= w′/2

  Bump3p(const Parameters& p, const ThreePolygons<DoubleDouble>& g) noexcept
      : gap(three_polygon_gap(g, p.width)),
        K(static_cast<double>(p.stiffness)),
        K_sine((DoubleDouble::exactly(K) * g.face.sine).hi),
        K_cosine((DoubleDouble::exactly(K) * g.face.cosine).hi),
        half_width(0.5 * static_cast<double>(p.width)),
        half_top(largest_on_top(p.radius, p.width, g.half_top)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real ax = absolute(x);
    const MaskOf<Real> inside = ax <= Real(half_width);
    const MaskOf<Real> on_top = ax <= Real(static_cast<double>(half_top));
    const MaskOf<Real> on_side = inside & !on_top;
    const auto bump = gap.at(ax, z, on_top);
    const Real value = larger(select(inside, bump.value, -z), Real(0));
    const Real slope = select(on_side, select(x < Real(0), Real(-K_sine), Real(K_sine)), Real(0));
    const MaskOf<Real> doubt = inside & bump.unclear;
    return {value * slope, value * select(on_side, Real(K_cosine), Real(K)), value > Real(0), doubt};
  }

  template <class N, class GeometryOf>
  Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) const noexcept {
    const float ax = __builtin_fabsf(x);
    if (2 * ax > p.width) return on_plane<N>(p.stiffness, z);
    const ThreePolygons<N>& g = geometry();
    if (ax <= half_top) {
      return along(g.height - N::exactly(static_cast<double>(z)), p.stiffness, N::exactly(0), N::exactly(1));
    }
    return along(side_gap(g.face, p.width, ax, z), p.stiffness, x < 0 ? -g.face.sine : g.face.sine, g.face.cosine);
  }
};

}  // namespace forceshade::fast
