// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force that the servo loop orders from frames that run beside it.

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
