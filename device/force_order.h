// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the servo loop orders of frames that run beside it.

#include <Eigen/Core>
#include <cstdint>

#include "forceshade/device.h"

namespace forceshade::device {

struct ForceOrder {
  Eigen::Vector3d force{0, 0, 0};  // N
  std::int64_t time = 0;           // CLOCK_MONOTONIC, ns
  Allowance allowance;
};

}  // namespace forceshade::device
