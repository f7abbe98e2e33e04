// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the servo loop orders of frames that run beside it.

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdint>

#include "forceshade/device.h"

namespace forceshade::device {

struct ForceOrder {
  Eigen::Vector3d force{0, 0, 0};  // N
  std::int64_t time = 0;           // CLOCK_MONOTONIC, ns
  Allowance allowance;
};

// How much of its force an order of this age (ns) still has: all for an eighth of the timeout, none at its end.
inline double share_of_force(std::int64_t age, std::chrono::nanoseconds timeout) noexcept {
  const auto whole = static_cast<double>(timeout.count()), held = whole / 8;
  return std::clamp((whole - static_cast<double>(age)) / (whole - held), 0.0, 1.0);
}

}  // namespace forceshade::device
