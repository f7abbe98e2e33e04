// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/tolerance.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace forceshade::conformance {
namespace {

constexpr std::array<std::pair<Unit, std::string_view>, 3> kNamesOfUnits{
    {{Unit::ulp, "ulp"}, {Unit::newton, "N"}, {Unit::percent, "%"}}};
constexpr double kMostUlps = 0x1p32;  // more than there are binary32 numbers between any two

}  // namespace

std::optional<Tolerance> tolerance_of(std::string_view text) {
  Tolerance tolerance;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tolerance.value);
  if (error != std::errc() || !std::isfinite(tolerance.value) || std::signbit(tolerance.value)) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [known, name] : kNamesOfUnits)
    if (unit == name) {
      tolerance.unit = known;
      const bool is_possible =
          known != Unit::ulp || (tolerance.value <= kMostUlps && tolerance.value == std::floor(tolerance.value));
      return is_possible ? std::optional(tolerance) : std::nullopt;
    }
  return std::nullopt;
}

std::string words_of(const Tolerance& tolerance) {
  if (tolerance.unit == Unit::ulp && tolerance.value == 0) return "correctly rounded";
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), tolerance.value);
  for (const auto& [known, name] : kNamesOfUnits)
    if (known == tolerance.unit) return std::string(digits.data(), end) + ' ' + std::string(name);
  return "";
}

}  // namespace forceshade::conformance
