// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

namespace forceshade::mesh {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// digits * 10^exponent, the digits without zeros in front.
struct Decimal {
  bool is_negative = false;
  std::string digits;
  std::int64_t exponent = 0;
};

// The decimal number of a word that from_chars takes for a finite one.
Decimal decimal_of(std::string_view word) {
  Decimal decimal;
  decimal.is_negative = word.starts_with('-');
  if (decimal.is_negative) word.remove_prefix(1);
  const std::size_t end = std::min(word.find_first_of("eE"), word.size());
  bool is_behind_point = false;
  for (const char c : word.substr(0, end)) {
    if (c == '.') {
      is_behind_point = true;
      continue;
    }
    if (c != '0' || !decimal.digits.empty()) decimal.digits += c;
    if (is_behind_point) --decimal.exponent;
  }
  if (end == word.size()) return decimal;
  word.remove_prefix(end + 1);
  if (word.starts_with('+')) word.remove_prefix(1);
  constexpr std::int64_t kFar = std::int64_t{1} << 60;
  std::int64_t exponent = 0;
  if (std::from_chars(word.data(), word.data() + word.size(), exponent).ec != std::errc{} || std::abs(exponent) > kFar)
    exponent = word.starts_with('-') ? -kFar : kFar;
  decimal.exponent += exponent;
  return decimal;
}

std::string product(const std::string& digits, unsigned factor) {
  std::string reversed;
  unsigned carry = 0;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
    carry += factor * static_cast<unsigned>(*digit - '0');
    reversed += static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  for (; carry != 0; carry /= 10) reversed += static_cast<char>('0' + carry % 10);
  return {reversed.rbegin(), reversed.rend()};
}

float nearest(const Decimal& decimal) {
  const float sign = decimal.is_negative ? -1.0F : 1.0F;
  if (decimal.digits.empty()) return sign * 0.0F;
  // The number is within 10^(place - 1) and 10^place.
  const std::int64_t place = static_cast<std::int64_t>(decimal.digits.size()) + decimal.exponent;
  if (place > 100) return sign * kInfinity;
  if (place < -100) return sign * 0.0F;
  const std::string text = decimal.digits + 'e' + std::to_string(decimal.exponent);
  float number = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc{}) return sign * number;
  return place > 0 ? sign * kInfinity : sign * 0.0F;
}

}  // namespace

std::optional<float> from_decimal(std::string_view word, Unit unit) {
  if (word.starts_with('+') && !word.substr(1).starts_with('-')) word.remove_prefix(1);
  float number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  const bool is_in_range = error == std::errc{};
  if (is_in_range && (unit == Unit::mm || !std::isfinite(number))) return number;
  Decimal decimal = decimal_of(word);
  if (unit == Unit::m) decimal.exponent += 3;
  if (unit == Unit::in) {
    decimal.digits = product(decimal.digits, 254);
    --decimal.exponent;
  }
  return nearest(decimal);
}

float from_binary(double number, Unit unit) {
  if (unit == Unit::mm || number == 0 || !std::isfinite(number)) return static_cast<float>(number);
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(number), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));  // 2^52 to 2^53
  // An inch is 127/5 mm. The quotient has 57 bits or more: a last bit of 1 where there is a remainder stands for all the bits
  // that follow, so that one rounding to 24 bits is that of the exact quotient.
  const std::uint64_t scaled = unit == Unit::m ? bits * 1000 : bits * 127 / 5 | static_cast<std::uint64_t>(bits * 127 % 5 != 0);
  return std::copysign(std::ldexp(static_cast<float>(scaled), exponent - 53), static_cast<float>(number));
}

}  // namespace forceshade::mesh
