// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device that rests at one place, 1 mm above the origin, and feels nothing.

#include "forceshade/device.h"

namespace forceshade::device {

class Stub final : public Device {
 public:
  Capabilities capabilities() const noexcept override { return {.model = "stub", .moves_an_arm = false}; }
  std::optional<Fault> start(double) noexcept override { return std::nullopt; }
  ReadResult read() noexcept override { return Reading{.position = {0, 0, 1}}; }
  std::optional<Fault> command(const Eigen::Vector3f&) noexcept override { return std::nullopt; }
};

}  // namespace forceshade::device
