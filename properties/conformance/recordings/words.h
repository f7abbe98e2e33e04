// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes measured values as text.

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <string>

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

}  // namespace forceshade::conformance
