// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-1p-shaded: one flat polygon, force shaded (thesis 4.5): K(-z) along the cylinder's normal for 2|x| <= w, else ẑ.

#include "fast/laws/outcome.h"
#include "fast/laws/shading.h"
#include "fast/laws/wall.h"

namespace forceshade::fast {

struct Bump1pShaded {
  static constexpr double kErrorBound = 0x1p-50;  // at most 6·2^-53
  static constexpr std::size_t kWideLimbs = 12;
  static constexpr int kSeparation = 406;  // bits: docs/proofs.md, "The last stage"
  template <class N>
  using Geometry = Wall::NoGeometry;
  template <class N>
  static Wall::NoGeometry geometry(const Parameters&) noexcept {
    return {};
  }

  Shading shading;
  double half_width;  // mm

  Bump1pShaded(const Parameters& p, const Wall::NoGeometry&) noexcept
      : shading(p), half_width(0.5 * static_cast<double>(p.width)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const Real shaded_x = select(absolute(x) <= Real(half_width), x, Real(0));  // x = 0 has the plane's own normal, ẑ
    const auto force = shading.force(larger(-z, Real(0)), shaded_x);
    return {force.x, force.z, z < Real(0), never<Real>()};
  }

  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf&, float x, float z) noexcept {
    if (2 * __builtin_fabsf(x) > p.width) return on_plane<N>(p.stiffness, z);
    return along_shaded(N::exactly(-static_cast<double>(z)), p.stiffness, p.radius, x);
  }
};

}  // namespace forceshade::fast
