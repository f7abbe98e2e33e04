// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// wall: F = -K z ẑ for z < 0 (thesis 2.2.1, sign and condition corrected: reference/laws/errata.md).

#include "fast/laws/outcome.h"
#include "fast/numbers/first_stage.h"
#include "forceshade/law.h"

namespace forceshade::fast {

struct Wall {
  // The binary64 product of two binary32 numbers is exact, and rounding it is all that is left to do.
  static constexpr double kErrorBound = 0;
  static constexpr std::size_t kWideLimbs = 4;
  static constexpr int kSeparation = 150;  // bits: docs/proofs.md, "The last stage"

  struct NoGeometry {};
  template <class N>
  using Geometry = NoGeometry;
  template <class N>
  static NoGeometry geometry(const Parameters&) noexcept {
    return {};
  }

  double K;  // N/mm

  Wall(const Parameters& p, const NoGeometry&) noexcept : K(static_cast<double>(p.stiffness)) {}

  template <class Real>
  FORCESHADE_INLINE FirstStage<Real> first_stage(Real, Real z) const {
    return {Real(0), larger(Real(-K) * z, Real(0)), z < Real(0), never<Real>()};
  }

  // geometry(): the geometry in numbers N, where it is needed; it takes the longest.
  template <class N, class GeometryOf>
  static Outcome<N> exact(const Parameters& p, const GeometryOf&, float, float z) noexcept {
    return on_plane<N>(p.stiffness, z);
  }
};

}  // namespace forceshade::fast
