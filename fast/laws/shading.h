// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The first stage of force shading: K·gap along (x/R, √(R² - x²)/R), the normal the cylinder would have at x.

#include "fast/numbers/first_stage.h"
#include "forceshade/law.h"

namespace forceshade::fast {

struct Shading {
  double R;
  double K_over_R;  // relative error 2^-53

  explicit Shading(const Parameters& p) noexcept
      : R(static_cast<double>(p.radius)), K_over_R(static_cast<double>(p.stiffness) / static_cast<double>(p.radius)) {}

  template <class Real>
  struct Force {
    Real x, z;
  };

  // |x| <= R. (R - x)(R + x) instead of R² - x²: no cancellation near the edge of a half cylinder. Adds at most 6·2^-53.
  template <class Real>
  FORCESHADE_INLINE Force<Real> force(Real gap, Real x) const {
    const Real scale = gap * Real(K_over_R);
    return {scale * x, scale * square_root((Real(R) - x) * (Real(R) + x))};
  }
};

}  // namespace forceshade::fast
