// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A real PHANToM (Premium, Omni, Touch) through the vendor's HDAPI, which runs in a process of its own. docs/phantom.md says
// why it is driven the way it is.

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "device/lasting_words.h"
#include "device/phantom/hdapi_library.h"
#include "device/phantom/phantom_shared.h"
#include "forceshade/device.h"
#include "system/process.h"

namespace forceshade::device {

struct PhantomOptions {
  // The time for which a force is held without a new command (it fades from an eighth of it on), and for which the driver may
  // run no frame.
  std::chrono::milliseconds watchdog_timeout{25};
  // The longest times for the driver to open the device and to run good frames, and for the user to calibrate it.
  std::chrono::milliseconds open{20'000}, start{5000}, calibration{120'000};
  double rate_tolerance = 0.05;  // the share by which the device's frames may miss the rate
  bool force = true;             // false: the force output is never switched on
};

// Called in the process that holds the device.
using HdapiLibrary = const hdapi::Functions& (*)();

class Phantom final : public Device {
 public:
  using Options = PhantomOptions;

  // `name` as in the vendor's set-up program; empty: the default device. Starts the process, which opens the device and reads
  // what it can do; switches no force on and runs no frame. The attendant lives as long as this. Throws DeviceError, with what
  // to check.
  Phantom(const std::string& name, const PhantomOptions& options, Attendant& attendant, HdapiLibrary library = hdapi::vendor);
  Phantom(const std::string& name, const PhantomOptions& options);  // without an attendant
  explicit Phantom(const std::string& name) : Phantom(name, PhantomOptions{}) {}

  // Zero force, output off, scheduler stopped, device released, in this order, and the process ended. Waits for the driver a
  // moment, not for ever: then the process is ended all the same, and the attendant gets a message.
  ~Phantom() override;
  Phantom(const Phantom&) = delete;
  Phantom& operator=(const Phantom&) = delete;

  Capabilities capabilities() const noexcept override { return capabilities_; }

  // Calibrates the device, with the attendant's help where it takes some; runs the driver's scheduler at this rate, rounded to
  // Hz; and switches forces on once half a second of frames was good.
  std::optional<Fault> start(double rate) noexcept override;

  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override;
  ReadResult read() noexcept override;
  void allow(const Allowance& allowance) noexcept override { allowance_ = allowance; }

  // Refuses, and holds no force, when one is not finite. A force beyond the device's highest is shortened to it.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override;

  State state() const noexcept override { return state_; }

  // The process that holds the device.
  int process() const noexcept { return process_ ? process_->id() : -1; }

 private:
  PhantomMessage answer(std::chrono::milliseconds timeout);
  void describe(const PhantomDescription& driver);
  std::string how_it_ended();
  void end_process() noexcept;
  Fault fault() noexcept;

  PhantomOptions options_;
  Attendant& attendant_;
  PhantomShared* shared_ = nullptr;
  std::optional<system::Process> process_;  // until it is known to have ended
  PhantomDescription description_;
  Capabilities capabilities_;
  LastingWords* room_;  // for the words of a fault
  bool started_ = false, failed_ = false;
  std::int64_t first_ = 0, read_ = 0;  // ns: of the first sample, and of the last that was read
  Allowance allowance_;
  State state_{.calibrated = false, .forces_on = false};
};

// "": the default device. Throws DeviceError.
std::unique_ptr<Device> open_phantom(const std::string& name, Attendant& attendant, Forces forces);

}  // namespace forceshade::device
