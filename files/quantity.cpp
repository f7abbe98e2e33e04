// SPDX-License-Identifier: BSD-3-Clause
#include "files/quantity.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "forceshade/bad_input.h"

namespace forceshade::files {
namespace {

// One of the unit is numerator/denominator of the base unit.
struct Unit {
  std::string_view name;
  long double numerator, denominator;
};

constexpr std::array kLengths{Unit{"", 1, 1},      Unit{"mm", 1, 1},  Unit{"mil", 254, 10000},
                              Unit{"in", 254, 10}, Unit{"cm", 10, 1}, Unit{"m", 1000, 1}};
constexpr std::array kStiffnesses{Unit{"", 1, 1}, Unit{"N/mm", 1, 1}, Unit{"N/m", 1, 1000}};
// The only one that is not exact: a radian is rounded to a long double.
constexpr std::array kAngles{Unit{"", 1, 1}, Unit{"deg", 1, 1}, Unit{"rad", 180, std::numbers::pi_v<long double>}};

// Rounded once, to the Real nearest to the quantity.
template <class Real, std::size_t kCount>
Real parse(const std::string& name, const std::string& text, const std::array<Unit, kCount>& units, const char* expected) {
  const auto refuse = [&] { return BadInput(name + ": expected " + expected + ", got \"" + text + "\""); };
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || !std::isfinite(number)) throw refuse();
  std::string_view suffix(rest, static_cast<std::size_t>(end - rest));
  while (suffix.starts_with(' ')) suffix.remove_prefix(1);
  for (const Unit& unit : units) {
    if (suffix != unit.name) continue;
    if (unit.numerator != unit.denominator)
      return static_cast<Real>(static_cast<long double>(number) * unit.numerator / unit.denominator);
    Real nearest = 0;  // read again: rounding to binary64 first could land on the wrong side of a tie
    if (std::from_chars(text.data(), rest, nearest).ec != std::errc{}) throw refuse();
    return nearest;
  }
  throw refuse();
}

}  // namespace

float parse_length(const std::string& name, const std::string& text) {
  return parse<float>(name, text, kLengths, "a length such as 15.24, 15.24mm, 600mil, 0.6in, 2.54cm or 0.01m");
}

float parse_stiffness(const std::string& name, const std::string& text) {
  return parse<float>(name, text, kStiffnesses, "a stiffness such as 0.5, 0.5N/mm or 500N/m");
}

double parse_angle(const std::string& name, const std::string& text) {
  return parse<double>(name, text, kAngles, "an angle such as 30, 30deg or 0.5rad");
}

std::vector<std::string> at_commas(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

}  // namespace forceshade::files
