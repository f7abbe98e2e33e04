// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The link of a device of DHD: its arm, whose calls are waited for no longer than a frame may take.

#include <memory>
#include <string>

#include "device/dhd/dhd_arm.h"
#include "device/dhd/timed_calls.h"
#include "device/frames/link.h"

namespace forceshade::device::dhd {

class Link final : public FrameLink {
 public:
  // Opens the device: `which` as in Arm::open(). Throws DeviceError.
  Link(const Functions& functions, const std::string& which, const FramedOptions& options);

  const Identity& identity() const noexcept { return frame_->identity; }

  FrameState exchange(const Eigen::Vector3d& force) override;
  void close() noexcept override;
  std::string remark() const override;

 private:
  // The data that a call that does not return may still refer to.
  struct Frame {
    Frame(const Functions& functions, bool may_force) : arm(functions, may_force) {}
    Arm arm;
    Identity identity{};
    FrameState state{.calibrated = false, .forces_on = false};
  };
  std::shared_ptr<Frame> frame_;
  std::chrono::milliseconds answer_, end_;
  TimedCalls calls_;
};

}  // namespace forceshade::device::dhd
