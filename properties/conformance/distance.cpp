// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/gmp.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <utility>

#include "properties/binary32.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr unsigned kFewDigits = 40, kMostDigits = 1000;

// Twice as many digits as the force has, and room for the squares of binary32 numbers beside them.
using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<2 * kMostDigits + 200>>;

// Binary32 numbers in order, with both zeros at 0.
std::int64_t index_of(float value) {
  const auto size = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(std::fabs(value)));
  return std::signbit(value) ? -size : size;
}

// The length of a vector whose components are no more than `off` (N) away from these; a few roundings of binary64 are included.
Bounds length(const Eigen::Vector3d& components, const Eigen::Vector3d& off) {
  constexpr double kSlack = 1e-15;
  const double least = (components.cwiseAbs() - off).cwiseMax(0).stableNorm(),
               most = (components.cwiseAbs() + off).stableNorm();
  return {least * (1 - kSlack), most * (1 + kSlack)};
}

// The largest change of the exact force by its rounding.
Eigen::Vector3d rounding_of(const reference::Rounded& rounded) {
  if (finished(rounded.status) != Status::contact) return Eigen::Vector3d::Zero();
  Eigen::Vector3d off;
  for (Eigen::Index axis = 0; axis < 3; ++axis) off[axis] = properties::half_spacing(rounded.force[axis]);
  return off;
}

// -1 where a lies surely below b, 1 where it lies surely above, 0 where that is not known.
int order(const Bounds& a, const Bounds& b) {
  return a.high <= b.low ? -1 : a.low > b.high ? 1 : 0;
}

using Rational = boost::multiprecision::mpq_rational;

// The square of a tolerance in N, or of a share, of 1.
Rational square_of(const Tolerance& tolerance) {
  Rational value(tolerance.value.fraction());
  mpq_canonicalize(value.backend().data());
  return tolerance.unit == Unit::newton ? Rational(value * value) : Rational(value * value / 10000);
}

// The sign of |answer - exact|² less the square of the tolerance, from so many digits; 0 where they are too few to know it.
int sign_of_excess(const Tolerance& tolerance, const Eigen::Vector3f& answer, const std::array<std::string, 3>& force,
                   unsigned digits) {
  Real difference = 0, size = 0, difference_off = 0, size_off = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Real exact(force[axis]), by = exact - Real(answer[static_cast<Eigen::Index>(axis)]);
    const Real off = abs(exact) * pow(Real(10), -static_cast<int>(digits) + 1);
    difference += by * by;
    difference_off += (2 * abs(by) + off) * off;
    size += exact * exact;
    size_off += (2 * abs(exact) + off) * off;
  }
  const Rational most = square_of(tolerance);
  const Real share = Real(numerator(most)) / Real(denominator(most));
  const Real square = tolerance.unit == Unit::newton ? share : Real(size * share);
  const Real square_off = tolerance.unit == Unit::newton ? Real(0) : Real(size_off * share);
  const Real excess = difference - square, off = (difference_off + square_off) * 2;
  return excess > off ? 1 : excess < -off ? -1 : 0;
}

// With the rounded force in the place of the exact one.
bool is_within_rounded(const Tolerance& tolerance, const Eigen::Vector3f& answer, const Eigen::Vector3f& rounded) {
  Rational difference = 0, size = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational exact(static_cast<double>(rounded[axis])), by = exact - Rational(static_cast<double>(answer[axis]));
    difference += by * by;
    size += exact * exact;
  }
  return difference <= (tolerance.unit == Unit::newton ? square_of(tolerance) : Rational(size * square_of(tolerance)));
}

constexpr std::array<std::pair<Unit, std::string_view>, 3> kNamesOfUnits{
    {{Unit::ulp, "ulp"}, {Unit::newton, "N"}, {Unit::percent, "%"}}};
constexpr double kMostUlps = 0x1p32;  // more than there are binary32 numbers between any two

}  // namespace

std::uint64_t ulps_between(float a, float b) {
  return static_cast<std::uint64_t>(std::abs(index_of(a) - index_of(b)));
}

Distance distance(const Eigen::Vector3f& answer, const reference::Rounded& rounded) {
  const Eigen::Vector3d off = rounding_of(rounded);
  Distance found{0, {kInfinite, kInfinite}, length(rounded.force.cast<double>(), off)};
  if (!answer.allFinite()) {
    found.ulps = kNoNumber;
    return found;
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    found.ulps = std::max(found.ulps, ulps_between(answer[axis], rounded.force[axis]));
  found.newtons = length(answer.cast<double>() - rounded.force.cast<double>(), off);
  return found;
}

bool is_within(const Tolerance& tolerance, const Eigen::Vector3f& answer, const reference::Rounded& rounded,
               const Digits& digits) {
  const Distance found = distance(answer, rounded);
  if (found.ulps == kNoNumber) return false;
  const auto value = tolerance.value.nearest<double>();
  if (tolerance.unit == Unit::ulp) return static_cast<double>(found.ulps) <= value;
  if (finished(rounded.status) != Status::contact && tolerance.unit == Unit::percent) return found.ulps == 0;
  constexpr double kDown = 1 - 1e-15, kUp = 1 + 1e-15;  // four roundings
  const Bounds most = tolerance.unit == Unit::newton
                          ? Bounds{value * kDown, value * kUp}
                          : Bounds{value / 100 * found.exact_newtons.low * kDown, value / 100 * found.exact_newtons.high * kUp};
  if (const int sure = order(found.newtons, most); sure != 0) return sure < 0;
  for (unsigned count = kFewDigits; count <= kMostDigits; count *= 5) {
    const auto force = digits(count);
    if (!force) return is_within_rounded(tolerance, answer, rounded.force);
    if (const int sign = sign_of_excess(tolerance, answer, *force, count); sign != 0) return sign < 0;
  }
  return true;
}

std::optional<Tolerance> tolerance_of(std::string_view text) {
  const auto value = files::Decimal::take(text);
  // Neither infinite in binary64 nor 0 there alone: an exact number of any exponent would fill the memory.
  if (!value || value->is_negative() || !std::isfinite(value->nearest<double>())) return std::nullopt;
  if (!value->is_zero() && value->nearest<double>() == 0) return std::nullopt;
  while (text.starts_with(' ')) text.remove_prefix(1);
  const auto* const unit = std::ranges::find(kNamesOfUnits, text, &std::pair<Unit, std::string_view>::second);
  if (unit == kNamesOfUnits.end()) return std::nullopt;
  if (unit->first == Unit::ulp && !(value->is_whole() && value->nearest<double>() <= kMostUlps)) return std::nullopt;
  return Tolerance{unit->first, *value};
}

std::string words_of(const Tolerance& tolerance) {
  if (tolerance.unit == Unit::ulp && tolerance.value.is_zero()) return "correctly rounded";
  std::string number = shortest(tolerance.value.nearest<double>());
  if (files::Decimal::of(number) != tolerance.value) number = tolerance.value.text();
  for (const auto& [known, name] : kNamesOfUnits)
    if (known == tolerance.unit) return number + ' ' + std::string(name);
  return "";
}

}  // namespace forceshade::conformance
