// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device whose frames a thread of ours makes (thread.h), whatever its link.

#include <memory>
#include <optional>
#include <string>

#include "device/frames/link.h"
#include "device/frames/thread.h"
#include "device/lasting_words.h"
#include "forceshade/device.h"

namespace forceshade::device {

// The properties of the device, and its name in messages.
struct FramedDescription {
  std::string name, partner;      // "the Inverse3"; "the Inverse Service", which answers for it
  std::string to_calibrate = {};  // the way to calibrate the device: "let the arm go home by itself"
  std::string model = {}, serial = {}, driver = {}, firmware = {}, forces = {};
  // The texts are the five above; latency and pace are those of every device of this kind. A peak force is required.
  Capabilities capabilities = {};
};

class FramedDevice final : public Device {
 public:
  // The link is open and has sent no force. The attendant lives as long as this.
  FramedDevice(std::unique_ptr<FrameLink> link, const FramedDescription& description, const FramedOptions& options,
               Attendant& attendant);
  // Closes the link, and reports what was seen of its frames.
  ~FramedDevice() override;
  FramedDevice(const FramedDevice&) = delete;
  FramedDevice& operator=(const FramedDevice&) = delete;

  Capabilities capabilities() const noexcept override { return capabilities_; }

  // Runs the frames, and is done once a window of them was good on a calibrated device.
  std::optional<Fault> start(double rate) noexcept override;

  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override;
  ReadResult read() noexcept override;
  void allow(const Allowance& allowance) noexcept override { allowance_ = allowance; }

  // Refuses, and holds no force, when one is not finite. A force beyond the device's highest is shortened to it.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override;

  State state() const noexcept override { return state_; }

 private:
  std::optional<std::string> why_not_ready(double rate);
  Fault failed(const std::string& words) noexcept;

  const FramedDescription description_;
  const FramedOptions options_;
  Attendant& attendant_;
  const Capabilities capabilities_;  // its texts are the description's
  LastingWords* room_;               // for the words of a fault
  std::unique_ptr<FrameLink> link_;
  std::unique_ptr<FrameThread> frames_;
  const char* fault_ = nullptr;        // its words, once there was one
  std::int64_t first_ = 0, read_ = 0;  // ns: of the first sample, and of the last that was read
  Allowance allowance_;
  State state_{.calibrated = false, .forces_on = false};
};

}  // namespace forceshade::device
