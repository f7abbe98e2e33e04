// SPDX-License-Identifier: BSD-3-Clause
#include "properties/binary32.h"

#include <charconv>
#include <cstdio>

namespace forceshade::properties {

std::string show(float value) {
  char hex[40];
  std::snprintf(hex, sizeof hex, "%a", static_cast<double>(value));
  char decimal[40];
  *std::to_chars(decimal, decimal + sizeof decimal - 1, value).ptr = '\0';
  return std::string(hex) + " (" + decimal + ")";
}

std::string show(const Eigen::Vector3f& value) {
  return "x = " + show(value.x()) + ", y = " + show(value.y()) + ", z = " + show(value.z());
}

}  // namespace forceshade::properties
