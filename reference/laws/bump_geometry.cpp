// SPDX-License-Identifier: BSD-3-Clause
#include "reference/laws/bump_geometry.h"

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_BigInt.h>
#include <CGAL/CORE_arithmetic_kernel.h>

#include <vector>

#include "reference/laws/slow_geometry.h"

namespace forceshade::reference {
namespace {

using Kernel = CGAL::Algebraic_kernel_d_1<CORE::BigInt>;

struct Ratio {
  CORE::BigInt numerator, denominator;
};

// w/2R in whole numbers.
Ratio half_width_over_radius(const Parameters& p) {
  const CORE::BigRat s =
      CORE::BigRat(static_cast<double>(p.width)) / (CORE::BigRat(2) * CORE::BigRat(static_cast<double>(p.radius)));
  return {CORE::numerator(s), CORE::denominator(s)};
}

// The three roots are -sin((π + α)/3), sin(α/3) and sin((π - α)/3), in this order; ours is the middle one. At w = 2R it
// meets the third, so that case is answered apart.
Exact sine_of_third(const Parameters& p) {
  if (p.width == 2 * p.radius) return Exact(1) / Exact(2);
  const Ratio s = half_width_over_radius(p);
  std::vector<Kernel::Algebraic_real_1> roots;
  const Kernel kernel;
  kernel.solve_1_object()(
      Kernel::Polynomial_1(s.numerator, CORE::BigInt(-3) * s.denominator, CORE::BigInt(0), CORE::BigInt(4) * s.denominator),
      false, std::back_inserter(roots));
  const auto between = kernel.bound_between_1_object();
  const CORE::BFInterval isolating{CORE::BigFloat(CGAL::to_double(between(roots.at(0), roots.at(1)))),
                                   CORE::BigFloat(CGAL::to_double(between(roots.at(1), roots.at(2))))};
  const std::vector<CORE::BigInt> coefficients{s.numerator, CORE::BigInt(-3) * s.denominator, CORE::BigInt(0),
                                               CORE::BigInt(4) * s.denominator};
  return CORE::rootOf(CORE::Polynomial<CORE::BigInt>(coefficients), isolating);
}

}  // namespace

Enclosure enclosing_theta(const Parameters& p) {
  const Enclosure R(p.radius), w(p.width);
  return Enclosure(2) / 3 * asin(w / (2 * R));
}

BumpGeometry<Enclosure> enclosing_geometry(const Parameters& p, FlatTop top) {
  BumpGeometry<Enclosure> g;
  g.R = Enclosure(p.radius);
  g.w = Enclosure(p.width);
  g.K = Enclosure(p.stiffness);
  const Enclosure half = g.w / 2;
  g.d = sqrt((g.R - half) * (g.R + half));
  g.h = g.R - g.d;
  if (top == FlatTop::not_needed) return g;
  const Enclosure theta = enclosing_theta(p), sine = sin(theta), cosine = cos(theta);
  g.w_prime = 2 * (half * cosine - g.d * sine);
  g.h_prime = half * sine + g.d * cosine - g.d;
  return g;
}

BumpGeometry<Exact> exact_geometry(const Parameters& p, FlatTop top) {
  BumpGeometry<Exact> g;
  g.R = Exact(static_cast<double>(p.radius));
  g.w = Exact(static_cast<double>(p.width));
  g.K = Exact(static_cast<double>(p.stiffness));
  const Exact half = g.w / Exact(2);
  g.d = sqrt((g.R - half) * (g.R + half));
  g.h = g.R - g.d;
  if (top == FlatTop::not_needed) return g;
  const Exact t = sine_of_third(p);
  g.w_prime = Exact(2) * g.R * t;
  g.h_prime = g.w_prime * (Exact(2) * t * sqrt((Exact(1) - t) * (Exact(1) + t)));  // w′ sin θ
  return g;
}

}  // namespace forceshade::reference
