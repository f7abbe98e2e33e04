// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How what was measured is said, and quantiles of it.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "files/csv.h"

namespace forceshade::conformance {

// Four significant digits, since more were hardly measured.
inline std::string brief(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 4).ptr};
}

inline std::string newtons(double value) {
  return brief(value) + " N";
}
inline std::string milliseconds(double seconds) {
  return brief(1000 * seconds) + " ms";
}

// "(1.5, 0, -2)".
inline std::string shown(const Eigen::Vector3d& v) {
  return '(' + files::shortest(v.x()) + ", " + files::shortest(v.y()) + ", " + files::shortest(v.z()) + ')';
}

// The smallest value that so large a share of them does not exceed; 0 of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto count = static_cast<double>(values.size());
  const auto at = static_cast<std::size_t>(std::clamp(std::ceil(share * count) - 1, 0.0, count - 1));
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
  return values[at];
}

}  // namespace forceshade::conformance
