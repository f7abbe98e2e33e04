// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// cylinder: axis along y through (0, -d); l = (x, z + d), ρ = ‖l‖; F = K(R - ρ)l/ρ for 0 < ρ < R, K R ẑ at ρ = 0
// (thesis 2.2.2, sign and condition corrected; the value on the axis is this project's convention).

#include "reference/laws/force.h"

namespace forceshade::reference {

struct Cylinder {
  using Surface = RoundSurface;
  static constexpr bool kIsShaded = false;
  static constexpr const char* kPotential = kCylinderPotential;

  template <class N>
  static Facet facet(const BumpGeometry<N>& g, const N& x, const N& z) {
    const N l = z + g.d;
    const N rho_squared = x * x + l * l;
    if (!(rho_squared < g.R * g.R)) return Facet::none;
    return rho_squared > N(0.0) ? Facet::cylinder : Facet::axis;
  }

  template <class N>
  static Force<N> force(Facet facet, const BumpGeometry<N>& g, const N& x, const N& z) {
    if (facet == Facet::none) return no_force<N>();
    if (facet == Facet::axis) return along(N(g.K * g.R), N(0.0), N(1.0));
    const N l = z + g.d;
    const N rho = sqrt(x * x + l * l);
    return along(N(g.K * (g.R - rho)), N(x / rho), N(l / rho));
  }
};

}  // namespace forceshade::reference
