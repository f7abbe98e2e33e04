// SPDX-License-Identifier: BSD-3-Clause
#include "properties/binary32.h"

#include "text/number_text.h"

namespace forceshade::properties {

std::string show(float value) {
  return hexfloat(static_cast<double>(value)) + " (" + shortest(value) + ")";
}

std::string show(const Eigen::Vector3f& value) {
  return "x = " + show(value.x()) + ", y = " + show(value.y()) + ", z = " + show(value.z());
}

}  // namespace forceshade::properties
