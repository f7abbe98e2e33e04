// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Another device with a lower peak force.

#include <algorithm>
#include <memory>
#include <utility>

#include "device/device.h"
#include "device/shortened.h"

namespace forceshade::device {

// No force of more than `peak` N reaches the device, whoever commands it; the supervisor takes `peak` for the device's own.
class Limited final : public Device {
 public:
  Limited(std::unique_ptr<Device> device, float peak) : device_(std::move(device)), peak_(peak) {}

  Capabilities capabilities() const noexcept override {
    Capabilities limited = device_->capabilities();
    limited.peak_force = std::min(limited.peak_force, peak_);
    limited.continuous_force = std::min(limited.continuous_force, peak_);
    return limited;
  }
  std::optional<Fault> start(double rate) noexcept override { return device_->start(rate); }
  ReadResult read() noexcept override { return device_->read(); }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override { return device_->wait_for_frame(deadline); }
  void allow(const Allowance& allowance) noexcept override { device_->allow(allowance); }

  // What is not finite is passed on, for the device to refuse.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    return device_->command(force.allFinite() ? shortened(force, static_cast<double>(peak_)) : force);
  }
  State state() const noexcept override { return device_->state(); }
  std::optional<std::size_t> readings_left() const noexcept override { return device_->readings_left(); }

 private:
  std::unique_ptr<Device> device_;
  float peak_;
};

}  // namespace forceshade::device
