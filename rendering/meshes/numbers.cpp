// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace forceshade::mesh {
namespace {

const files::Decimal& millimetres(Unit unit) {
  static const std::array<files::Decimal, 4> each{1, 10, 1000, *files::Decimal::of("25.4")};
  return each[static_cast<std::size_t>(unit)];
}

}  // namespace

std::optional<float> from_decimal(std::string_view word, const files::Decimal& unit) {
  if (word.starts_with('+') && !word.substr(1).starts_with('-')) word.remove_prefix(1);
  float number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc{} && (unit.is_one() || !std::isfinite(number))) return number;
  return (*files::Decimal::of(word) * unit).nearest<float>();
}

std::optional<float> from_decimal(std::string_view word, Unit unit) {
  return from_decimal(word, millimetres(unit));
}

float from_binary(double number, const files::Decimal& unit) {
  if (unit.is_one() || number == 0 || !std::isfinite(number)) return static_cast<float>(number);
  return (files::Decimal(number) * unit).nearest<float>();
}

float from_binary(double number, Unit unit) {
  if (unit == Unit::mm || number == 0 || !std::isfinite(number)) return static_cast<float>(number);
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(number), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));  // 2^52 to 2^53
  // An inch is 127/5 mm. The quotient has 57 bits or more: a last bit of 1 where there is a remainder stands for all the bits
  // that follow, so that one rounding to 24 bits is that of the exact quotient.
  const std::uint64_t scaled = unit == Unit::in ? bits * 127 / 5 | static_cast<std::uint64_t>(bits * 127 % 5 != 0)
                                                : bits * (unit == Unit::cm ? 10 : 1000);
  return std::copysign(std::ldexp(static_cast<float>(scaled), exponent - 53), static_cast<float>(number));
}

}  // namespace forceshade::mesh
