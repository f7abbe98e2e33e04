// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An arm whose frames a thread of ours makes, over a link that has no protocol.

#include <memory>

#include "device/frames/framed_device.h"
#include "tests/world/session.h"

namespace forceshade::world {

class PlainLink final : public device::FrameLink {
 public:
  explicit PlainLink(Arm& arm) : arm_(arm) {}
  device::FrameState exchange(const Eigen::Vector3d& force) override { return arm_.frame(force); }
  void close() noexcept override { arm_.close(); }

 private:
  Arm& arm_;
};

inline device::FramedDescription description_of_an_arm() {
  device::FramedDescription description{.name = "the arm", .partner = "the arm"};
  description.capabilities = {.workspace_low = Eigen::Vector3f::Constant(-100),
                              .workspace_high = Eigen::Vector3f::Constant(100),
                              .resolution = 0.05F,
                              .peak_force = static_cast<float>(Arm::kPeak),
                              .continuous_force = 1,
                              .buttons = 1};
  return description;
}

inline std::unique_ptr<device::Device> open_framed(Arm& arm) {
  static device::Attendant nobody;
  return std::make_unique<device::FramedDevice>(std::make_unique<PlainLink>(arm), description_of_an_arm(),
                                                device::FramedOptions{}, nobody);
}

}  // namespace forceshade::world
