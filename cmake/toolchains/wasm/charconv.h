// SPDX-License-Identifier: BSD-3-Clause
// <charconv> for float and double, by functions of the C library that round correctly. The locale is always "C" in WebAssembly.
#pragma once
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <type_traits>

namespace std {

template <class Float>
Float forceshade_from_text(const char* text) {
  if constexpr (is_same_v<Float, float>)
    return strtof(text, nullptr);
  else
    return strtod(text, nullptr);
}

inline to_chars_result forceshade_copied(char* first, char* last, const char* text) {
  const size_t length = strlen(text);
  if (static_cast<size_t>(last - first) < length) return {last, errc::value_too_large};
  memcpy(first, text, length);
  return {first + length, errc()};
}

template <class Float>
  requires is_floating_point_v<Float>
to_chars_result to_chars(char* first, char* last, Float value, chars_format format, int digits) {
  char text[512];
  snprintf(text, sizeof text, format == chars_format::fixed ? "%.*f" : format == chars_format::scientific ? "%.*e" : "%.*g", digits,
           static_cast<double>(value));
  return forceshade_copied(first, last, text);
}

// The fewest digits that read back as the same number.
template <class Float>
  requires is_floating_point_v<Float>
to_chars_result to_chars(char* first, char* last, Float value, chars_format format) {
  char text[512];
  if (format == chars_format::hex) {  // of what is not negative, without 0x
    snprintf(text, sizeof text, "%a", static_cast<double>(value));
    return forceshade_copied(first, last, text + 2);
  }
  for (int digits = 0; digits < 400; ++digits) {
    snprintf(text, sizeof text, format == chars_format::fixed ? "%.*f" : "%.*e", digits, static_cast<double>(value));
    if (isnan(value) || forceshade_from_text<Float>(text) == value) break;
  }
  return forceshade_copied(first, last, text);
}

// The shorter of the two notations; the fixed one where both are as long.
template <class Float>
  requires is_floating_point_v<Float>
to_chars_result to_chars(char* first, char* last, Float value) {
  char plain[512], scientific[64];
  const auto length = to_chars(plain, plain + sizeof plain, value, chars_format::fixed).ptr - plain;
  const auto other = to_chars(scientific, scientific + sizeof scientific, value, chars_format::scientific).ptr - scientific;
  return forceshade_copied(first, last, string(length <= other ? plain : scientific, static_cast<size_t>(min(length, other))).c_str());
}

// The longest beginning that is a decimal number, "inf" or "nan".
template <class Float>
  requires is_floating_point_v<Float>
from_chars_result from_chars(const char* first, const char* last, Float& value) {
  const char* p = first;
  const auto digits = [&](bool& is_zero) {
    const char* const begin = p;
    for (; p != last && *p >= '0' && *p <= '9'; ++p) is_zero = is_zero && *p == '0';
    return p - begin;
  };
  const auto word = [&](const char* its) {
    const char* q = p;
    for (; *its != 0; ++its, ++q)
      if (q == last || (*q | 0x20) != *its) return false;
    p = q;
    return true;
  };
  if (p != last && *p == '-') ++p;
  bool is_zero = true;
  const bool is_word = word("infinity") || word("inf") || word("nan");
  if (!is_word) {
    auto count = digits(is_zero);
    if (p != last && *p == '.') {
      const char* const point = p++;
      const auto behind = digits(is_zero);
      if (count + behind == 0) p = point;
      count += behind;
    }
    if (count == 0) return {first, errc::invalid_argument};
    if (p != last && (*p | 0x20) == 'e') {
      const char* const before = p++;
      if (p != last && (*p == '-' || *p == '+')) ++p;
      bool any = true;
      if (digits(any) == 0) p = before;
    }
  }
  const Float read = forceshade_from_text<Float>(string(first, p).c_str());
  if (!is_word && (isinf(read) || (read == 0 && !is_zero))) return {p, errc::result_out_of_range};
  value = read;
  return {p, errc()};
}

}  // namespace std
