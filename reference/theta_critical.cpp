// SPDX-License-Identifier: BSD-3-Clause
#include "reference/theta_critical.h"

#include <boost/multiprecision/gmp.hpp>
#include <mutex>
#include <optional>

#include "reference/laws/slow_geometry.h"
#include "reference/numbers/decimal.h"
#include "reference/numbers/numbers.h"

namespace forceshade::reference {
namespace {

using Fraction = boost::multiprecision::mpq_rational;

Enclosure in_degrees(const Enclosure& radians) {
  // acos(-1) is π, enclosed at the precision in force.
  return radians * 180 / acos(Enclosure(-1));
}

Fraction number_of(const RationalAngle& angle) {
  Fraction number(angle.number);
  mpq_canonicalize(number.backend().data());
  return number;
}

Enclosure enclosed_degrees(const RationalAngle& angle) {
  Enclosure number;
  mpfi_set_q(number.backend().data(), number_of(angle).backend().data());
  return angle.is_radians ? in_degrees(number) : number;
}

Enclosure enclosing_degrees(const Parameters& bump) {
  return in_degrees(enclosing_theta(bump) * 3);
}

// Niven (1956): the arcsine of a rational number in (0, 1] is a rational number of degrees only for 1/2 and 1.
std::optional<unsigned> rational_degrees(const Parameters& bump) {
  if (bump.width == bump.radius) return 60;
  if (bump.width == 2 * bump.radius) return 180;
  return std::nullopt;
}

}  // namespace

std::string subtended_degrees(const Parameters& bump, unsigned polygons, unsigned digits) {
  const std::lock_guard lock(exact_arithmetic);
  return correctly_rounded(
      digits, [&] { return Enclosure(enclosing_degrees(bump) / polygons); },
      [&](const CORE::BigRat& q) {
        const auto rational = rational_degrees(bump);
        // An irrational number is no q; it would have been distinguished by now.
        return rational ? sign(CORE::BigRat(*rational) / CORE::BigRat(polygons) - q) : 1;
      });
}

RationalAngle::RationalAngle(double degrees) : number(Fraction(degrees).str()) {}

unsigned polygons_needed(const Parameters& bump, const RationalAngle& theta_critical) {
  const std::lock_guard lock(exact_arithmetic);
  const auto rational = rational_degrees(bump);
  // A whole number of parts is possible here alone. An irrational number of degrees is no multiple of a rational one, and
  // the arcsine of an algebraic number other than 0 none of a rational number of radians (Lindemann).
  if (rational && !theta_critical.is_radians) {
    const Fraction parts = Fraction(*rational) / number_of(theta_critical);
    return boost::multiprecision::mpz_int(numerator(parts) / denominator(parts)).convert_to<unsigned>() + 1;
  }
  for (unsigned bits = 128;; bits *= 2) {
    set_precision(bits);
    const Enclosure degrees = rational ? Enclosure(*rational) : enclosing_degrees(bump);
    const Enclosure parts = degrees / enclosed_degrees(theta_critical);
    const Multiprecision low = floor(lower(parts)), high = floor(upper(parts));
    if (low == high) return low.convert_to<unsigned>() + 1;
  }
}

}  // namespace forceshade::reference
