// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/rounding.h"

#include <algorithm>
#include <cmath>

namespace forceshade::reference::meshes {
namespace {

constexpr int kDigits = 24;       // of binary32
constexpr int kLeastUnit = -149;  // the exponent of its smallest positive number

Integer shifted(const Integer& value, int places) {
  return places < 0 ? Integer(value >> static_cast<unsigned>(-places)) : Integer(value << static_cast<unsigned>(places));
}

// value · 2^places, with exponent 0.
RootSum scaled(RootSum value, int places) {
  const int up = std::max(value.exponent + places, 0), down = std::max(-value.exponent - places, 0);
  return {shifted(value.whole, up), value.root_is_negative, shifted(value.square, 2 * up), shifted(value.under, down), 0};
}

// The largest integer that is not above a value of exponent 0 that is not negative.
Integer whole_part(const RootSum& value) {
  const Integer root = sqrt(value.square);
  const bool is_exact = root * root == value.square;
  return (value.root_is_negative ? value.whole - root - (is_exact ? 0 : 1) : value.whole + root) / value.under;
}

}  // namespace

int compared(const RootSum& value, const Integer& over, const Integer& under) {
  const RootSum whole = scaled(value, 0);
  const Integer rest = whole.whole * under - over * whole.under, square = whole.square * under * under;
  const int sign = rest.sign(), root_sign = square.is_zero() ? 0 : value.root_is_negative ? -1 : 1;
  if (sign * root_sign >= 0) return sign != 0 ? sign : root_sign;
  return sign * Integer(rest * rest).compare(square);
}

float nearest_binary32(const RootSum& value) {
  const int sign = compared(value, 0, 1);
  if (sign == 0) return 0;
  RootSum size = value;
  if (sign < 0) {
    size.whole = -size.whole;
    size.root_is_negative = !size.root_is_negative;
  }
  Integer units = whole_part(scaled(size, -kLeastUnit));
  const int bits = units.is_zero() ? 0 : static_cast<int>(msb(units)) + 1;
  const int unit = std::max(bits - kDigits, 0);  // 2^unit of the smallest number
  units >>= static_cast<unsigned>(unit);
  const int past_half = compared(scaled(size, -kLeastUnit - unit), 2 * units + 1, 2);
  if (past_half > 0 || (past_half == 0 && units % 2 == 1)) ++units;
  const float nearest = std::ldexp(static_cast<float>(units.convert_to<std::int64_t>()), unit + kLeastUnit);  // exact
  return sign < 0 && nearest != 0 ? -nearest : nearest;
}

float nearest_binary32(const Fraction& value, int exponent) {
  return nearest_binary32(RootSum{.whole = value.over, .under = value.under, .exponent = exponent});
}

// √(over / under) = √(over under) / under
float nearest_binary32_root(const Fraction& value, int exponent) {
  return nearest_binary32(RootSum{.square = value.over * value.under, .under = value.under, .exponent = exponent});
}

Integer integer_of(float value, int scale) {
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);
  const Integer digits = static_cast<std::int64_t>(std::ldexp(fraction, kDigits));
  const int places = exponent - kDigits + scale;
  // A shift to the right of a negative number would round; here no digit is lost.
  return digits < 0 ? Integer(-shifted(-digits, places)) : shifted(digits, places);
}

}  // namespace forceshade::reference::meshes
