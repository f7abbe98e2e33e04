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

// Rounds a positive number of which it is known that 2^(top - 1) < number < 2^(top + 1). count_units(unit) is the largest
// integer k with k · 2^unit <= number; past_half(k, unit) the sign of number - (k + 1/2) 2^unit.
template <class CountUnits, class PastHalf>
float round_positive(int top, CountUnits count_units, PastHalf past_half) {
  int unit = std::max(top - kDigits - 1, kLeastUnit);
  Integer units = count_units(unit);
  for (; units >= Integer(1) << kDigits; units = count_units(unit)) ++unit;
  const int sign = past_half(units, unit);
  if (sign > 0 || (sign == 0 && units % 2 == 1)) ++units;
  return std::ldexp(static_cast<float>(units.convert_to<std::int64_t>()), unit);  // exact: at most 24 bits
}

int bits(const Integer& positive) {
  return static_cast<int>(msb(positive)) + 1;
}

}  // namespace

float nearest_binary32(const Fraction& value, int exponent) {
  if (value.over.is_zero()) return 0;
  const Integer over = abs(value.over);
  // Both sides of a comparison with k 2^unit, times 2^-min(unit, exponent).
  const auto sides = [&](const Integer& k, int unit) {
    const int least = std::min(unit, exponent);
    return std::pair(shifted(over, exponent - least), Integer(shifted(value.under, unit - least) * k));
  };
  const float size = round_positive(
      bits(over) - bits(value.under) + exponent,
      [&](int unit) {
        const auto [number, one] = sides(1, unit);
        return Integer(number / one);
      },
      [&](const Integer& k, int unit) {
        const auto [number, halves] = sides(2 * k + 1, unit - 1);
        return number.compare(halves);
      });
  return value.over < 0 && size != 0 ? -size : size;
}

float nearest_binary32_root(const Fraction& value, int exponent) {
  if (value.over.is_zero()) return 0;
  // The squares of a comparison with k 2^unit: value 4^exponent and k² 4^unit.
  const auto squares = [&](const Integer& k, int unit) {
    const int least = std::min(unit, exponent);
    return std::pair(shifted(value.over, 2 * (exponent - least)), Integer(shifted(value.under, 2 * (unit - least)) * k * k));
  };
  const int log = bits(value.over) - bits(value.under);  // 2^(log - 1) < value < 2^(log + 1)
  return round_positive((log >= 0 ? log / 2 : (log - 1) / 2) + exponent,
                        [&](int unit) {
                          const auto [number, one] = squares(1, unit);
                          return Integer(sqrt(Integer(number / one)));
                        },
                        [&](const Integer& k, int unit) {
                          const auto [number, halves] = squares(2 * k + 1, unit - 1);
                          return number.compare(halves);
                        });
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
