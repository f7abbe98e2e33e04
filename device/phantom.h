// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A real PHANToM (Premium, Omni, Touch) through the vendor's HDAPI. docs/device.md says why it is driven the way it is.

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "forceshade/device/attendant.h"
#include "forceshade/device/device.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/phantom_frames.h"

namespace forceshade::device {

// One at a time in a process: the driver has one scheduler and one stack of errors.
class Phantom final : public Device {
 public:
  struct Options {
    // For how long a force is held without a new command, and for how long the driver may run no frame.
    std::chrono::milliseconds patience{25};
    // For how long start() waits for the driver.
    std::chrono::milliseconds start{3000};
    bool force = true;  // false: the force output is never switched on
  };

  // `name` as in the vendor's set-up program; empty: the default device. Initialises the driver and asks what the device can
  // do; switches no force on and runs no frame. Throws DeviceError, with what to check.
  Phantom(const std::string& name, const Options& options, Attendant& attendant);
  Phantom(const std::string& name, const Options& options);
  explicit Phantom(const std::string& name) : Phantom(name, Options{}) {}

  // Zero force, output off, scheduler stopped, device released, in this order. Waits for the driver a moment, not for ever.
  ~Phantom() override;
  Phantom(const Phantom&) = delete;
  Phantom& operator=(const Phantom&) = delete;

  Capabilities capabilities() const noexcept override { return capabilities_; }

  // Runs the driver's scheduler at this rate, rounded to Hz, looks at the device for a while, and switches forces on.
  std::optional<Fault> start(double rate) noexcept override;

  ReadResult read() noexcept override;

  // Refuses, and holds no force, when one is not finite. A force beyond the device's highest is shortened to it.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override;

  State state() const noexcept override { return state_; }

 private:
  using Clock = PhantomFrames::Clock;

  // Taken before anything is asked of the driver, given back last.
  struct Turn {
    Turn();
    ~Turn();
  };

  void ask_what_it_can();
  bool went_well(const char* step) noexcept;
  bool known() noexcept;
  Fault fault() noexcept;

  Turn turn_;
  const hdapi::Functions& hd_;
  Options options_;
  hdapi::HHD device_ = hdapi::kInvalidDevice;
  std::string model_;
  Capabilities capabilities_;
  int update_rate_ = 0;          // Hz
  std::array<char, 512>* room_;  // for the words of a fault, which outlive this
  hdapi::Trouble trouble_;
  std::unique_ptr<PhantomFrames> frames_;
  hdapi::HDSchedulerHandle callback_ = hdapi::kInvalidSchedulerHandle;
  bool running_ = false;
  Clock::time_point first_{};
  State state_{.calibrated = false, .forces_on = false};
};

// "": the default device. Throws DeviceError.
std::unique_ptr<Device> open_phantom(const std::string& name, Attendant& attendant, Forces forces);

}  // namespace forceshade::device
