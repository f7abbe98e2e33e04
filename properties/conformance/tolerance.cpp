// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

constexpr std::array<std::pair<Unit, std::string_view>, 3> kNamesOfUnits{
    {{Unit::ulp, "ulp"}, {Unit::newton, "N"}, {Unit::percent, "%"}}};
constexpr double kMostUlps = 0x1p32;  // more than there are binary32 numbers between any two

}  // namespace

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
