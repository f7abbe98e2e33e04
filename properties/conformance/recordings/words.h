// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes measured values as text.

#include <Eigen/Core>
#include <string>

#include "text/number_text.h"

namespace forceshade::conformance {

// Four significant digits, since more were hardly measured.
inline std::string brief(double value) {
  return digits(value, 4);
}

inline std::string newtons(double value) {
  return brief(value) + " N";
}
inline std::string milliseconds(double seconds) {
  return brief(1000 * seconds) + " ms";
}

// "(1.5, 0, -2)".
inline std::string shown(const Eigen::Vector3d& v) {
  return '(' + shortest(v.x()) + ", " + shortest(v.y()) + ", " + shortest(v.z()) + ')';
}

}  // namespace forceshade::conformance
