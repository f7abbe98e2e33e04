// SPDX-License-Identifier: BSD-3-Clause
#include "files/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "forceshade/error.h"

namespace forceshade::files {
namespace {

// One of the unit is so many of the base unit: a decimal number.
struct Unit {
  std::string_view name, size;
};

constexpr std::array kLengths{Unit{"", "1"},      Unit{"mm", "1"},  Unit{"mil", "0.0254"},
                              Unit{"in", "25.4"}, Unit{"cm", "10"}, Unit{"m", "1000"}};
constexpr std::array kStiffnesses{Unit{"", "1"}, Unit{"N/mm", "1"}, Unit{"N/m", "0.001"}};
constexpr std::array kDampings{Unit{"", "1"}, Unit{"Ns/mm", "1"}, Unit{"Ns/m", "0.001"}};
constexpr std::array kForces{Unit{"", "1"}, Unit{"N", "1"}};
constexpr std::array kTimes{Unit{"s", "1"}, Unit{"ms", "0.001"}};
constexpr std::array kNumbers{Unit{"", "1"}};
constexpr const char *kLength = "a length such as 15.24, 15.24mm, 600mil, 0.6in, 2.54cm or 0.01m",
                     *kStiffness = "a stiffness such as 0.5, 0.5N/mm or 500N/m",
                     *kDamping = "a damping such as 0.002, 0.002Ns/mm or 2Ns/m", *kForce = "a force such as 0.25 or 0.25N",
                     *kTime = "a time such as 2ms or 0.002s", *kNumber = "a number such as 0.5",
                     *kAngle = "an angle such as 30, 30deg or 0.5rad";

Error refusal(const std::string& name, const std::string& expected, const std::string& text) {
  return Error(name + ": expected " + expected + ", got \"" + text + "\"");
}

// The number and the word behind it.
std::pair<Decimal, std::string_view> parts_of(const std::string& name, const std::string& text, const char* expected) {
  std::string_view rest = text;
  const auto number = Decimal::take(rest);
  if (!number || !std::isfinite(number->nearest<double>())) throw refusal(name, expected, text);
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  return {*number, rest};
}

template <std::size_t kCount>
Decimal parse(const std::string& name, const std::string& text, const std::array<Unit, kCount>& units, const char* expected) {
  const auto [number, suffix] = parts_of(name, text, expected);
  const auto* const unit = std::ranges::find(units, suffix, &Unit::name);
  if (unit == units.end()) throw refusal(name, expected, text);
  return number * *Decimal::of(unit->size);
}

float rounded(const std::string& name, const std::string& text, const Decimal& exact, const char* expected) {
  const auto nearest = exact.nearest<float>();
  if (!std::isfinite(nearest)) throw refusal(name, expected, text);
  return nearest;
}

// 180/pi lies above this and below the decimal whose last digit is one more.
constexpr std::string_view kDegrees =
    "57."
    "2957795130823208767981548141051703324054724665643215491602438612028471483215526324409689958511109441"
    "8622338163286489328144826460124831503606826786341194212252638809746726792630798870289311076793826144"
    "2638263158209610460487020506444259656841120171912057738566280431284962624203376187937297623870790340";

}  // namespace

Decimal exact_length(const std::string& name, const std::string& text) {
  return parse(name, text, kLengths, kLength);
}

float parse_length(const std::string& name, const std::string& text) {
  return rounded(name, text, exact_length(name, text), kLength);
}

float parse_stiffness(const std::string& name, const std::string& text) {
  return rounded(name, text, parse(name, text, kStiffnesses, kStiffness), kStiffness);
}

float parse_damping(const std::string& name, const std::string& text) {
  return rounded(name, text, parse(name, text, kDampings, kDamping), kDamping);
}

float parse_force(const std::string& name, const std::string& text) {
  return rounded(name, text, parse(name, text, kForces, kForce), kForce);
}

float parse_time(const std::string& name, const std::string& text) {
  return rounded(name, text, parse(name, text, kTimes, kTime), kTime);
}

float parse_binary32(const std::string& name, const std::string& text) {
  return rounded(name, text, parse(name, text, kNumbers, kNumber), kNumber);
}

Angle exact_angle(const std::string& name, const std::string& text) {
  const auto [number, suffix] = parts_of(name, text, kAngle);
  if (suffix == "rad") return {number, true};
  if (suffix.empty() || suffix == "deg") return {number, false};
  throw refusal(name, kAngle, text);
}

double parse_angle(const std::string& name, const std::string& text) {
  const Angle angle = exact_angle(name, text);
  if (!angle.is_radians) return angle.number.nearest<double>();
  std::string above(kDegrees);
  ++above.back();
  const auto low = (angle.number * *Decimal::of(kDegrees)).nearest<double>(),
             high = (angle.number * *Decimal::of(above)).nearest<double>();
  if (low == high && std::isfinite(low)) return low;
  throw refusal(name, kAngle, text);
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
