// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The person at the terminal who also has a window, in which they steer a simulated hand.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/device_run.h"
#include "device/simulated/steering.h"

namespace forceshade::apps {

// Prepares a device as attendant() does.
class SteeringAttendant final : public device::Attendant {
 public:
  // start: where the hand begins, mm in the device's frame; called once a device is to be steered.
  SteeringAttendant(bool in_reset_pose, bool with_buttons, std::function<Eigen::Vector3d()> start)
      : person_(attendant(in_reset_pose, with_buttons)), start_(std::move(start)) {}

  void report(const std::string& words) noexcept override { person_->report(words); }
  bool did(const std::string& words) noexcept override { return person_->did(words); }
  bool has_left() const noexcept override { return person_->has_left(); }
  const std::atomic<std::uint16_t>* buttons() noexcept override { return person_->buttons(); }
  device::Steering* steering() noexcept override {
    if (!steering_) steering_.emplace(start_());
    return &*steering_;
  }

  // Null unless a device has been opened that is steered.
  device::Steering* steered() noexcept { return steering_ ? &*steering_ : nullptr; }

 private:
  std::unique_ptr<device::Attendant> person_;
  std::function<Eigen::Vector3d()> start_;
  std::optional<device::Steering> steering_;
};

}  // namespace forceshade::apps
