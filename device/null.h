// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// No device at all: it rests at the origin and feels nothing. For trying a set-up before anything can move.

#include "forceshade/device.h"

namespace forceshade::device {

class Null final : public Device {
 public:
  Capabilities capabilities() const noexcept override { return {.model = "null", .moves_an_arm = false}; }
  std::optional<Fault> start(double rate) noexcept override {
    rate_ = rate;
    return std::nullopt;
  }
  ReadResult read() noexcept override { return Reading{.time = static_cast<double>(readings_++) / rate_}; }
  std::optional<Fault> command(const Eigen::Vector3f&) noexcept override { return std::nullopt; }

 private:
  double rate_ = 1000;  // Hz
  std::size_t readings_ = 0;
};

}  // namespace forceshade::device
