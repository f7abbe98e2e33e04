// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers as text, whatever the locale.

#include <charconv>
#include <string>

namespace forceshade {

// Reads back as the same binary32: "0.1".
inline std::string shortest(float value) {
  char text[48];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// "0.0001235" with four digits; also what gnuplot reads.
inline std::string digits(double value, int count) {
  char text[48];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, count).ptr};
}

}  // namespace forceshade
