// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// bump-cylinder: F = F_cylinder + F_wall everywhere, each where its own penetration is positive, rounded once (thesis 4.3).

#include "fast/laws/cylinder.h"

namespace forceshade::fast {

struct BumpCylinder : Cylinder {
  static constexpr double kErrorBound = Cylinder::kErrorBound;  // bump_cylinder.g proves 17.7·2^-53
  static constexpr int kSeparation = 949;                       // bits: docs/proofs.md, "The last stage"

  using Cylinder::Cylinder;

  // Below the axis, inside the cylinder, the two forces oppose and may cancel: a later stage answers there.
  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real x, Real z) const {
    const auto cylinder = off_axis(x, z);
    const Real from_wall = larger(Real(-K) * z, Real(0));
    const MaskOf<Real> contact = cylinder.contact | (z < Real(0));
    const MaskOf<Real> doubt = cylinder.doubt | (cylinder.contact & (z <= Real(axis)));
    return {cylinder.x, cylinder.z + from_wall, contact, doubt};
  }

  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf& geometry, float x, float z) noexcept {
    const Outcome<N> cylinder = Cylinder::exact<N>(p, geometry, x, z);
    if (cylinder.contact == Sign::unknown || z >= 0) return cylinder;
    const Outcome<N> wall = on_plane<N>(p.stiffness, z);
    if (cylinder.contact != Sign::positive) return wall;
    return {Sign::positive, cylinder.x, cylinder.z + wall.z};
  }
};

}  // namespace forceshade::fast
