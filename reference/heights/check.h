// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that the numbers of a part lie in their domain, as docs/height-maps.md states it; each kind has an error_of() in its
// own header.

#include <cmath>
#include <optional>

#include "forceshade/law.h"

namespace forceshade::reference {

using DomainError = std::optional<ParameterError>;

inline DomainError check(const char* name, const char* unit, float value, float low, float high) {
  return value >= low && value <= high ? std::nullopt : DomainError(ParameterError{name, unit, value, low, high});
}

inline DomainError check_centre(float x, float y) {
  if (const auto error = check("centre x", "mm", x, -10000, 10000)) return error;
  return check("centre y", "mm", y, -10000, 10000);
}

inline DomainError check_height(float value) {
  return check("height", "mm", value, -10000, 10000);
}

inline DomainError check_value(float value) {
  return value == 0 ? std::nullopt : check("size of a value", "mm", std::fabs(value), std::ldexp(1.0F, -30), 10000);
}

}  // namespace forceshade::reference
