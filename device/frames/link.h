// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device whose frames a thread of ours makes, as that thread sees it: one exchange a frame. A new family of devices is its
// link, the description of its device, and the function that opens both (framed_device.h).

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace forceshade::device {

// The result of one frame.
struct FrameState {
  Eigen::Vector3d position{0, 0, 0};  // mm, in the axes of the laws: x right, y away from the user, z up; finite
  std::uint16_t buttons = 0;          // bit k is set while button k is down
  bool calibrated = true, forces_on = true;
  const char* forces_off = "";                            // as State has it
  bool withheld = false;                                  // zero was sent instead of the force
  std::optional<Eigen::Vector3d> applied = std::nullopt;  // N: the force that the device says it applied, where it says one
};

// Times: how long something may last.
struct FramedOptions {
  std::chrono::milliseconds watchdog_timeout{25};  // a force is held without a new command; it fades from an eighth of it on
  std::chrono::milliseconds answer{25};            // the device may leave a frame without an answer
  // The longest times for the device to answer at all, the frames to be good, and the user to calibrate the device.
  std::chrono::milliseconds open{5000}, start{5000}, calibration{120'000};
  std::chrono::milliseconds end{0};  // the shortest time that it has to take the last zero and to end its session
  double rate_tolerance = 0.05;      // the share by which the frames may miss the rate
  bool force = true;                 // false: no command that gives one is ever sent
  bool device_paces = false;         // it answers at frames of its own, so that no clock of ours has to wait between two
};

// After it is made, it is called by the thread of the frames alone.
class FrameLink {
 public:
  // Lets the device go, where close() was not called.
  virtual ~FrameLink() = default;

  // Sends this force, in N, and brings the state. A link that was made for no force sends nothing that could give one, and its
  // device's forces are off. Throws std::runtime_error, with what happened and what to do, where the device does not answer
  // within FramedOptions::answer, or answers what it must not.
  virtual FrameState exchange(const Eigen::Vector3d& force) = 0;

  // Sends zero force where that is possible, then lets the device go. Waits for it a moment, not for ever. No exchange follows,
  // and an exchange that threw may have gone before.
  virtual void close() noexcept = 0;

  // After close(): what else the user has to be told about the run, as the rest of a sentence; empty where that is nothing.
  virtual std::string remark() const { return {}; }
};

}  // namespace forceshade::device
