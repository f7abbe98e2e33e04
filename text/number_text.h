// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers as text, whatever the locale: the one place that prints them for files and people, and reads words that are numbers.

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace forceshade {

template <class... Format>
std::string number_text(auto value, Format... format) {
  char text[400];  // a binary64 has up to 309 digits in front of the point
  return {text, std::to_chars(text, text + sizeof text, value, format...).ptr};
}

// The shortest decimal that reads back as the same number: "0.1".
inline std::string shortest(float value) {
  return number_text(value);
}
inline std::string shortest(double value) {
  return number_text(value);
}

// The same without an exponent, so that 100000 is not 1e+05.
inline std::string without_exponent(double value) {
  return number_text(value, std::chars_format::fixed);
}

// "0x1.8p+1", "nan", "-inf".
inline std::string hexfloat(double value) {
  if (!std::isfinite(value)) return number_text(value);
  return (std::signbit(value) ? "-0x" : "0x") + number_text(std::abs(value), std::chars_format::hex);
}

// "0.0001235" with four digits; also what gnuplot reads.
inline std::string digits(double value, int count) {
  return number_text(value, std::chars_format::general, count);
}

// The number that a word is from its first character to its last, as from_chars reads it: without a + and without blanks.
// Returns nothing for another word, and for a number that the type cannot hold.
template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc{} && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace forceshade
