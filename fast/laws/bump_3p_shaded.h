// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-3p-shaded: three polygons, force shaded (thesis 4.5): the magnitude of bump-3p along the cylinder's normal.

#include "fast/laws/outcome.h"
#include "fast/laws/polygon_gap.h"
#include "fast/laws/shading.h"
#include "fast/laws/top_edge.h"

namespace forceshade::fast {

struct Bump3pShaded {
  static constexpr double kErrorBound = 0x1.8p-50;  // gap 2^-51, shading 6·2^-53
  static constexpr std::size_t kWideLimbs = 64;
  static constexpr int kSeparation = 3729;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = ThreePolygons<N>;
  template <class N>
  static ThreePolygons<N> geometry(const Parameters& p) noexcept {
    return three_polygons<N>(p.radius, p.width);
  }

  ThreePolygonGap gap;
  Shading shading;
  double half_width;  // mm
  float half_top;     // mm: the largest binary32 <= w′/2

  Bump3pShaded(const Parameters& p, const ThreePolygons<DoubleDouble>& g) noexcept
      : gap(three_polygon_gap(g, p.width)),
        shading(p),
        half_width(0.5 * static_cast<double>(p.width)),
        half_top(largest_on_top(p.radius, p.width, g.half_top)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real ax = absolute(x);
    const MaskOf<Real> inside = ax <= Real(half_width);
    const auto bump = gap.at(ax, z, ax <= Real(static_cast<double>(half_top)));
    const Real value = larger(select(inside, bump.value, -z), Real(0));
    const auto force = shading.force(value, select(inside, x, Real(0)));
    const MaskOf<Real> doubt = inside & bump.unclear;
    return {force.x, force.z, value > Real(0), doubt};
  }

  template <class N, class GeometryOf>
  Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) const noexcept {
    const float ax = __builtin_fabsf(x);
    if (2 * ax > p.width) return on_plane<N>(p.stiffness, z);
    if (2 * ax == p.width) return along_shaded(at_foot<N>(z), p.stiffness, p.radius, x);
    const ThreePolygons<N>& g = geometry();
    const N gap = ax <= half_top ? g.height - N::exactly(static_cast<double>(z)) : side_gap(g.face, p.width, ax, z);
    return along_shaded(gap, p.stiffness, p.radius, x);
  }
};

}  // namespace forceshade::fast
