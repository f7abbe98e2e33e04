// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that the numbers of a part lie in their domain (docs/height-maps.md); each kind has an error_of() in its own header.

#include <cmath>
#include <initializer_list>
#include <optional>

#include "fast/domain.h"
#include "fast/heights/limits.h"
#include "forceshade/law.h"

namespace forceshade::fast {

using MaybeError = std::optional<ParameterError>;

inline MaybeError first_outside(std::initializer_list<ParameterError> numbers) noexcept {
  for (const ParameterError& number : numbers)
    if (!(number.value >= number.low && number.value <= number.high)) return number;
  return std::nullopt;
}

inline ParameterError symmetric(const char* name, const char* unit, float value, float largest) noexcept {
  return {name, unit, value, -largest, largest};
}
inline ParameterError centre_x(float x) noexcept {
  return symmetric("centre x", "mm", x, kLargestCoordinate);
}
inline ParameterError centre_y(float y) noexcept {
  return symmetric("centre y", "mm", y, kLargestCoordinate);
}
inline ParameterError height_of(float value) noexcept {
  return symmetric("height", "mm", value, height_limits::kLargestHeight);
}

// The error of the value of a sample or a knot.
inline MaybeError error_of_value(float value) noexcept {
  const float size = std::fabs(value);
  if (value == 0 || (size >= kPositionQuantum && size <= height_limits::kLargestHeight)) return std::nullopt;
  return ParameterError{"size of a value", "mm", size, kPositionQuantum, height_limits::kLargestHeight};
}

}  // namespace forceshade::fast
