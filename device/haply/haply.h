// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A Haply Inverse3 through Haply's Inverse Service, a program that runs beside this one. docs/haply.md says what was taken from
// its documents, and what is assumed.

#include <chrono>
#include <memory>
#include <string>

#include "device/haply/haply_frames.h"
#include "forceshade/device.h"

namespace forceshade::device {

struct HaplyOptions {
  // The time for which a force is held without a new command (it fades from an eighth of it on), and for which the service may
  // leave a frame without an answer.
  std::chrono::milliseconds watchdog_timeout{25};
  // How long the service may take to answer at all, the frames to be good, and the user to calibrate the device.
  std::chrono::milliseconds open{5000}, start{5000}, calibration{120'000};
  double rate_tolerance = 0.05;  // by which share the frames may miss the rate
  bool force = true;             // false: no command that gives one is ever sent
};

class Haply final : public Device {
 public:
  // `name`: an id or a serial number that the service lists; empty: the only one. Connects and reads what the device is;
  // commands nothing. The attendant lives as long as this. Throws DeviceError, with what to check.
  Haply(const std::string& name, const HaplyOptions& options, Attendant& attendant);
  // Zero force, then the end of the session, which is not begun again.
  ~Haply() override;
  Haply(const Haply&) = delete;
  Haply& operator=(const Haply&) = delete;

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
  void connect(const std::string& name);
  haply::Message next_message();
  void describe(const haply::Inverse3& arm, bool has_grip);
  std::optional<std::string> why_not_ready();
  Fault fault() noexcept { return Fault{room_->data()}; }
  Fault failed_with(const std::string& words) noexcept;

  HaplyOptions options_;
  Attendant& attendant_;
  haply::FrameSettings settings_;
  std::unique_ptr<haply::Socket> socket_;  // until the frames have it
  std::unique_ptr<haply::FrameThread> frames_;
  std::string model_, serial_, driver_, firmware_, forces_;  // what capabilities_ refers to
  Capabilities capabilities_;
  LastingWords* room_;  // for the words of a fault
  bool failed_ = false;
  std::int64_t first_ = 0, read_ = 0;  // ns: of the first sample, and of the last that was read
  Allowance allowance_;
  State state_{.calibrated = false, .forces_on = false};
};

}  // namespace forceshade::device
