// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "device/shortened.h"
#include "forceshade/device.h"

namespace forceshade::device {

Capabilities Limited::capabilities() const noexcept {
  Capabilities limited = device_->capabilities();
  limited.peak_force = std::min(limited.peak_force, peak_);
  limited.continuous_force = std::min(limited.continuous_force, peak_);
  return limited;
}

std::optional<Fault> Limited::command(const Eigen::Vector3f& force) noexcept {
  return device_->command(force.allFinite() ? shortened(force, static_cast<double>(peak_)) : force);
}

}  // namespace forceshade::device
