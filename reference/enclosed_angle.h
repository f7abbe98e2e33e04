// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Angles in the slow number types. Callers hold exact_arithmetic.

#include <boost/multiprecision/gmp.hpp>

#include "reference/numbers/numbers.h"
#include "reference/theta_critical.h"

namespace forceshade::reference {

using Fraction = boost::multiprecision::mpq_rational;

inline Enclosure in_degrees(const Enclosure& radians) {
  // acos(-1) is π, enclosed at the precision in force.
  return radians * 180 / acos(Enclosure(-1));
}

inline Fraction number_of(const RationalAngle& angle) {
  Fraction number(angle.number);
  mpq_canonicalize(number.backend().data());
  return number;
}

inline Enclosure enclosed_degrees(const RationalAngle& angle) {
  Enclosure number;
  mpfi_set_q(number.backend().data(), number_of(angle).backend().data());
  return angle.is_radians ? in_degrees(number) : number;
}

}  // namespace forceshade::reference
