// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a force-feedback device is to the servo loop: it gives positions and takes forces. Neither depends on the
// other. Positions and forces are in the frame of docs/laws.md: x right, y into the page, z up.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

namespace forceshade::device {

// What became of the commands: the forces that the device's frames really sent, which are what a hand feels. A frame measures
// a position x(j) and sends a force F(j), which acts until the next one.
struct Sent {
  Eigen::Vector3f acted{0, 0, 0};   // N: up to the position of this reading
  Eigen::Vector3f acting{0, 0, 0};  // N: from there on; zero where it will be the command that answers this reading
  double work = 0;  // mJ given to the hand since start(), less what it put in: the sum of F(j-1)·(x(j) - x(j-1))
};

// How much the hand may be given: a frame sends no force that could bring Sent::work above `work` within a step of this length.
struct Allowance {
  double work = std::numeric_limits<double>::infinity();  // mJ
  double longest_step = 0;                                // mm
};

struct Reading {
  Eigen::Vector3f position{0, 0, 0};                                  // mm
  double time = 0;                                                    // s, by the device's own clock
  std::uint16_t buttons = 0;                                          // bit k is set while button k is down
  std::optional<Eigen::Vector3f> gimbal = std::nullopt;               // rad, from a device that has one
  std::optional<std::array<std::int64_t, 3>> encoder = std::nullopt;  // counts, from a device that shows them
  std::optional<std::array<double, 3>> joints = std::nullopt;         // rad, from a device that shows them: its driver's angles
  std::optional<Sent> sent = std::nullopt;                            // from a device that keeps an account
};

// Nothing is wrong and nothing more will come.
struct EndOfData {};

struct Fault {
  const char* words;  // for people; lives as long as the program
};

using ReadResult = std::variant<Reading, EndOfData, Fault>;

// What a device can do, fixed while it is open. The default has no limits.
struct Capabilities {
  static constexpr float kNone = std::numeric_limits<float>::infinity();

  std::string_view model = "unknown";  // as long as the device lives, like the next three
  std::string_view serial = {}, driver = {}, firmware = {};
  Eigen::Vector3f workspace_low = Eigen::Vector3f::Constant(-kNone), workspace_high = Eigen::Vector3f::Constant(kNone);  // mm
  float resolution = 0;  // mm, as a data sheet has it
  // N, as a data sheet has them. Without a peak it gives no force that a hand could feel: nobody needs to be kept from it.
  float peak_force = kNone, continuous_force = kNone;
  // False for a device whose hand is computed, too: its arm moves only in a simulation, and its time is the number of readings,
  // so that a late tick holds no force for longer than it should be held.
  bool moves_an_arm = true;
  bool latency = false;  // a command acts through the period after the next reading, not up to it
  float friction = 0;    // N: the least at its tip, as a data sheet has it
  double highest_rate = std::numeric_limits<double>::infinity();  // Hz
  // What the device's own driver ends a run for: mm/s, N/s.
  double highest_speed = std::numeric_limits<double>::infinity(), highest_slew = std::numeric_limits<double>::infinity();
  bool paces = false;  // it has frames of its own, which the servo loop can follow
  int buttons = 0;
  bool gimbal = false;
};

// What a device reports about itself, as of the last reading.
struct State {
  bool calibrated = true;  // else its positions mean nothing
  bool forces_on = true;   // else commands are accepted and not carried out: a dead-man switch, amplifiers off
  float temperature = 0;   // of the hottest motor: 0 is the room's, 1 the highest allowed
  double update_rate = 0;  // Hz, by the driver's own count; 0 from a device that does not count
};

// read() and command() are called from the servo loop, in turns: they allocate nothing, throw nothing and return well within
// a tick. Until start() a device gives no force, whatever else is called, and when destroyed it gives none again.
class Device {
 public:
  virtual ~Device() = default;

  virtual Capabilities capabilities() const noexcept = 0;

  // Once, before the first reading, with the rate in Hz at which there will be readings. Takes its time.
  virtual std::optional<Fault> start(double rate) noexcept = 0;

  virtual ReadResult read() noexcept = 0;

  // Waits for the next frame of a device that paces, no longer than until `deadline`, and for a signal. When the last frame
  // began. Both in ns of CLOCK_MONOTONIC.
  virtual std::int64_t wait_for_frame(std::int64_t deadline) noexcept { return deadline; }

  // Sets the allowance for the commands that follow. A device without an account of its own may ignore it.
  virtual void allow(const Allowance& allowance) noexcept { static_cast<void>(allowance); }

  // Holds this force, in N, until the next command. Zero must be carried out even after a fault. A device with real motors
  // sets the force to zero by itself when it gets no command for some 25 ms: the program may be gone then.
  virtual std::optional<Fault> command(const Eigen::Vector3f& force) noexcept = 0;

  virtual State state() const noexcept { return {}; }

  // How many readings are still to come, from a device whose readings end.
  virtual std::optional<std::size_t> readings_left() const noexcept { return std::nullopt; }
};

}  // namespace forceshade::device
