// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-2p-shaded: two polygons, force shaded (thesis 4.5): the magnitude of bump-2p along the cylinder's normal.

#include "fast/laws/outcome.h"
#include "fast/laws/polygon_gap.h"
#include "fast/laws/shading.h"

namespace forceshade::fast {

struct Bump2pShaded {
  static constexpr double kErrorBound = 0x1.8p-50;  // gap 2^-51, shading 6·2^-53
  static constexpr std::size_t kWideLimbs = 32;
  static constexpr int kSeparation = 1031;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = BumpFace<N>;
  template <class N>
  static BumpFace<N> geometry(const Parameters& p) noexcept {
    return two_polygon_face<N>(p.radius, p.width);
  }

  LinearGap gap;
  Shading shading;
  double half_width;  // mm

  Bump2pShaded(const Parameters& p, const BumpFace<DoubleDouble>& face) noexcept
      : gap(two_polygon_gap(face, p.width)), shading(p), half_width(0.5 * static_cast<double>(p.width)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real ax = absolute(x);
    const MaskOf<Real> inside = ax <= Real(half_width);
    const auto bump = gap.at(ax, z);
    const Real value = larger(select(inside, bump.value, -z), Real(0));
    const auto force = shading.force(value, select(inside, x, Real(0)));
    const MaskOf<Real> doubt = inside & bump.unclear;
    return {force.x, force.z, value > Real(0), doubt};
  }

  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) noexcept {
    const float ax = __builtin_fabsf(x);
    if (2 * ax > p.width) return on_plane<N>(p.stiffness, z);
    if (2 * ax == p.width) return along_shaded(at_foot<N>(z), p.stiffness, p.radius, x);
    const BumpFace<N>& face = geometry();
    return along_shaded(side_gap(face, p.width, ax, z), p.stiffness, p.radius, x);
  }
};

}  // namespace forceshade::fast
