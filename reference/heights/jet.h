// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map at a point: its height and its gradient, in any of the reference's numbers.

#include <array>

#include "forceshade/height_map.h"
#include "reference/numbers/ball64.h"
#include "reference/numbers/numbers.h"
#include "reference/position.h"

namespace forceshade::reference {

using Rational = CORE::BigRat;

template <class N>
struct Jet {
  N U;       // mm
  N Ux, Uy;  // mm/mm

  static Jet flat() { return {N(0.0), N(0.0), N(0.0)}; }
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.U + b.U, a.Ux + b.Ux, a.Uy + b.Uy}; }
  friend Jet operator-(const Jet& a) { return {-a.U, -a.Ux, -a.Uy}; }
};

// The square of an enclosure; balls have their own.
template <class N>
N square(const N& x) {
  return x * x;
}
template <class N>
std::array<N, 2> sine_and_cosine(const N& angle) {
  return {sin(angle), cos(angle)};
}

// A position in the plane, quantised, mm.
struct Point2 {
  double x, y;
};

// A coordinate relative to a centre, which is quantised like a position.
template <class N>
N from_centre(double coordinate, float centre) {
  return quantised(centre) == 0 ? N(coordinate) : N(coordinate) - N(static_cast<double>(centre));
}

// True if a point, relative to the centre of a disk, lies inside it; on the rim the side with larger x decides.
inline bool is_inside(const Rational& x, const Rational& y, const Rational& radius) {
  const Rational outside = x * x + y * y - radius * radius;
  return sign(outside) < 0 || (sign(outside) == 0 && sign(x) < 0);
}

}  // namespace forceshade::reference
