// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/reference/rational.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace forceshade::exact {
namespace {

constexpr std::size_t kLongest = 10000;
constexpr int kLargestExponent = 10000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The digits at the beginning of the text, which loses them.
std::string_view take_digits(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_digit);
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

// GMP would read 010 as octal.
std::string without_zeros(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string_view::npos ? "0" : std::string(digits.substr(first));
}

// What follows e or E, all of the rest.
std::optional<int> exponent_of(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  take(text, "+-");
  const std::string_view digits = take_digits(text);
  if (digits.empty() || !text.empty()) return std::nullopt;
  int exponent = 0;
  for (const char digit : digits) {
    exponent = 10 * exponent + (digit - '0');
    if (exponent > kLargestExponent) return std::nullopt;
  }
  return is_negative ? -exponent : exponent;
}

}  // namespace

std::optional<std::string> rational_of(std::string_view text) {
  if (text.size() > kLongest) return std::nullopt;
  const std::string sign = text.starts_with('-') ? "-" : "";
  take(text, "+-");
  const std::string_view whole = take_digits(text);
  if (take(text, "/")) {
    const std::string denominator = without_zeros(take_digits(text));
    if (whole.empty() || denominator == "0" || !text.empty()) return std::nullopt;
    return sign + without_zeros(whole) + "/" + denominator;
  }
  const std::string_view fraction = take(text, ".") ? take_digits(text) : std::string_view();
  if (whole.empty() && fraction.empty()) return std::nullopt;
  int exponent = 0;
  if (take(text, "eE")) {
    const std::optional<int> read = exponent_of(text);
    if (!read) return std::nullopt;
    exponent = *read;
  } else if (!text.empty()) {
    return std::nullopt;
  }
  exponent -= static_cast<int>(fraction.size());
  const std::string zeros(static_cast<std::size_t>(std::abs(exponent)), '0');
  const std::string digits = std::string(whole) + std::string(fraction);
  return sign + without_zeros(exponent > 0 ? digits + zeros : digits) + "/1" + (exponent < 0 ? zeros : "");
}

}  // namespace forceshade::exact
