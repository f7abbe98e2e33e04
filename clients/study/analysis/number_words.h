// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers as the tables print them, whatever the locale.

#include <charconv>
#include <cmath>
#include <string>

#include "study/analysis/bootstrap.h"

namespace forceshade::analysis {

// "0.85"; "-" where it is undefined.
inline std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char text[400];  // a binary64 has up to 309 digits in front of the point
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals).ptr};
}

// "0.81 to 0.89"; "-" for an undefined interval.
inline std::string fixed(const Interval& interval, int decimals) {
  return interval.is_defined() ? fixed(interval.low, decimals) + " to " + fixed(interval.high, decimals) : "-";
}

}  // namespace forceshade::analysis
