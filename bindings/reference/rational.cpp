// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/reference/rational.h"

#include <cstddef>

#include "files/decimal.h"

namespace forceshade::exact {
namespace {

constexpr std::size_t kLongest = 10000;
constexpr int kLargestExponent = 10000;

// GMP would read 010 as octal. Nothing where the text is no whole number.
std::optional<std::string> whole_number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  const std::size_t first = text.find_first_not_of('0');
  return first == std::string_view::npos ? "0" : std::string(text.substr(first));
}

}  // namespace

std::optional<std::string> rational_of(std::string_view text) {
  if (text.size() > kLongest) return std::nullopt;
  const std::string sign = text.starts_with('-') ? "-" : "";
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos) {
    const auto above = whole_number(text.substr(0, slash)), below = whole_number(text.substr(slash + 1));
    if (!above || !below || *below == "0") return std::nullopt;
    return sign + *above + '/' + *below;
  }
  const auto decimal = text.starts_with('-') ? std::nullopt : files::Decimal::of(text);
  // Digits behind the point count, too.
  if (!decimal || decimal->exponent() > kLargestExponent ||
      decimal->exponent() < -kLargestExponent - static_cast<int>(kLongest))
    return std::nullopt;
  return sign + decimal->fraction();
}

}  // namespace forceshade::exact
