// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A force-feedback device for the servo loop: it gives positions and takes forces. Neither depends on the other.
//
//   const auto hand = device::open_device("simulated");  // or "phantom", "replay:strokes.csv", "null"
//   if (const auto fault = hand->start(1000)) throw std::runtime_error(fault->words);
//   const device::ReadResult reading = hand->read();
//   if (const auto* its = std::get_if<device::Reading>(&reading)) std::printf("%g mm\n", double{its->position.z()});
//   hand->command({0, 0, 0});
//
// Positions (mm) and forces (N) are in the frame of docs/laws.md: x right, y into the page, z up. Times are in s.
//
// Errors: a device that cannot be opened throws; one that is open answers with a Fault, whose words live as long as the
// program.
//
// Threads: a device belongs to one thread at a time, but for its attendant's buttons. Your own driver derives from
// Device. Between a direct command and the hand there is neither the supervisor nor the passivity controller:
// run_servo_loop() of servo_loop.h has both.
//
// Not promised: what a device does after a fault but to carry out zero force; and the models that can be simulated. The
// devices: docs/device.md.

#if __cplusplus < 202002L
#error "forceshade is in C++20: expected -std=c++20 or later"
#endif

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/error.h"

namespace forceshade::device {

// The forces that the device's frames actually sent, which a hand feels. A frame measures a position x(j) and sends a force
// F(j), which acts until the next one.
struct Sent {
  Eigen::Vector3f acted{0, 0, 0};   // N: up to the position of this reading
  Eigen::Vector3f acting{0, 0, 0};  // N: from there on; zero where it will be the command that answers this reading
  double work = 0;  // mJ given to the hand since start(), less what it put in: the sum of F(j-1)·(x(j) - x(j-1))
  // Since start(): how often frames came to send a part of the commanded force only, and in s, for how long in all. They do so
  // when commands are late, and go back to the whole as slowly as after a gentle start.
  int fades = 0;
  double faded = 0;
};

// The most energy for the hand: a frame sends no force that could bring Sent::work above `work` within a step of this length.
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

// The abilities and limits of a device, fixed while it is open. The default has no limits.
struct Capabilities {
  static constexpr float kNone = std::numeric_limits<float>::infinity();

  std::string_view model = "unknown";  // as long as the device lives, like the next four
  std::string_view serial = {}, driver = {}, firmware = {};
  // The driver's change of a commanded force, in words; empty where the hand is given the command.
  std::string_view forces = {};
  Eigen::Vector3f workspace_low = Eigen::Vector3f::Constant(-kNone), workspace_high = Eigen::Vector3f::Constant(kNone);  // mm
  float resolution = 0;  // mm, as a data sheet has it
  // N, as a data sheet has them. Without a peak it gives no force that a hand could feel, and needs no guard.
  float peak_force = kNone, continuous_force = kNone;
  // False for a device whose hand is computed, too: its arm moves only in a simulation, and its time is the number of readings,
  // so that a late tick holds no force for longer than it should be held.
  bool moves_an_arm = true;
  bool latency = false;  // a command acts through the period after the next reading, not up to it
  float friction = 0;    // N: the least at its tip, as a data sheet has it
  float damping = 0;     // N·s/m: the least at its tip; 0: not known
  double highest_rate = std::numeric_limits<double>::infinity();  // Hz
  // The limits beyond which the device's own driver ends a run: mm/s, N/s.
  double highest_speed = std::numeric_limits<double>::infinity(), highest_slew = std::numeric_limits<double>::infinity();
  bool paces = false;  // it has frames of its own, which the servo loop can follow
  int buttons = 0;
  bool gimbal = false;
};

// The device's report about itself, as of the last reading.
struct State {
  bool calibrated = true;       // else its positions mean nothing
  bool forces_on = true;        // else commands are accepted and not carried out: a dead-man switch, amplifiers off
  const char* forces_off = "";  // why they are off, where the device says so; it lasts as long as the program
  float temperature = 0;        // of the hottest motor: 0 is the room's, 1 the highest allowed
  double update_rate = 0;       // Hz, by the driver's own count; 0 from a device that does not count
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

  // The number of readings still to come, from a device whose readings end.
  virtual std::optional<std::size_t> readings_left() const noexcept { return std::nullopt; }
};

class Steering;  // device/simulated/steering.h

// The person who prepares a device: what a device has to say to them, and what it needs them to do.
// This one hears nothing and does nothing.
class Attendant {
 public:
  virtual ~Attendant() = default;

  virtual void report(const std::string& words) noexcept { static_cast<void>(words); }

  // Shows what is to be done and waits. False if it was not done.
  virtual bool did(const std::string& words) noexcept {
    static_cast<void>(words);
    return false;
  }

  // True if they have given up waiting.
  virtual bool has_left() const noexcept { return false; }

  // Buttons for a device that has none of its own: bit k is set while they hold button k down. As long as they live; null if
  // they have none to offer.
  static constexpr int kButtons = 2;  // as many as the stylus of a Touch has
  virtual const std::atomic<std::uint16_t>* buttons() noexcept { return nullptr; }

  // The place where they want a simulated hand, with a mouse for instance. As long as they live; null if they steer nothing.
  virtual Steering* steering() noexcept { return nullptr; }
};

// The device, or the vendor's software for it, cannot be used. what() says why and what to check.
struct DeviceError : Error {
  using Error::Error;
};

// Permits or forbids forces. With `never`, a real device's force output is never switched on.
enum class Forces { as_commanded, never };

// `name` is KIND or KIND:REST, for instance "replay:strokes.csv". No device moves by being opened. The attendant, who lives as
// long as the device, prepares one that cannot prepare itself; the default one does nothing. Throws Error, with the
// kinds that there are, and what the kind's own opener throws.
std::unique_ptr<Device> open_device(const std::string& name, Attendant& attendant, Forces forces = Forces::as_commanded);
std::unique_ptr<Device> open_device(const std::string& name);

// A recorded hand as a device: it goes its way whatever force it is given.
//
// Plays at the pace of its own time stamps, whatever the rate: the k-th reading is where the hand was k periods after the first
// time stamp. At a time stamp, within kSameTime, that is the recorded position to the bit; between two of them it is on the
// straight line from one to the other, in proportion to the time, and buttons, gimbal and encoder are those of the earlier.
// Nothing is read beyond the last time stamp. A recording of a higher rate than the loop's loses the positions between ticks.
class Replay final : public Device {
 public:
  static constexpr double kSameTime = 1e-9;  // s: more than rounding moves a multiple of a period, less than any hand does

  // Times are finite and increase from each reading to the next; throws std::invalid_argument where they do not, or when there
  // is no reading.
  explicit Replay(std::vector<Reading> recording);

  // Reads a CSV with columns t_s, x_mm, y_mm and z_mm. Positions are taken as they are, NaN too: to judge them is the law's
  // business. Throws std::runtime_error with the line of a time that is not finite or does not increase, also when there is no
  // row.
  static Replay load(const std::string& path);

  Capabilities capabilities() const noexcept override { return {.model = "replay", .moves_an_arm = false}; }
  std::optional<Fault> start(double rate) noexcept override;
  ReadResult read() noexcept override;
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override {
    last_command_ = force;
    return std::nullopt;
  }
  // Not known until it is started.
  std::optional<std::size_t> readings_left() const noexcept override;

  const std::vector<Reading>& recording() const noexcept { return recording_; }
  const Eigen::Vector3f& last_command() const noexcept { return last_command_; }

 private:
  // s since the first time stamp
  double time_of(std::size_t recorded) const noexcept { return recording_[recorded].time - recording_.front().time; }

  std::vector<Reading> recording_;
  double period_ = 0;                    // s; 0 until started
  std::size_t readings_ = 0, read_ = 0;  // the numbers of those at this period, and of those read
  std::size_t last_ = 0;                 // the last recorded one that is not after the time of the reading
  Eigen::Vector3f last_command_{0, 0, 0};
};

// No force of more than `peak` N reaches the device, whoever commands it; the supervisor takes `peak` for the device's own.
class Limited final : public Device {
 public:
  Limited(std::unique_ptr<Device> device, float peak) : device_(std::move(device)), peak_(peak) {}

  Capabilities capabilities() const noexcept override;
  std::optional<Fault> start(double rate) noexcept override { return device_->start(rate); }
  ReadResult read() noexcept override { return device_->read(); }
  std::int64_t wait_for_frame(std::int64_t deadline) noexcept override { return device_->wait_for_frame(deadline); }
  void allow(const Allowance& allowance) noexcept override { device_->allow(allowance); }

  // A force that is not finite is passed on, for the device to refuse.
  std::optional<Fault> command(const Eigen::Vector3f& force) noexcept override;
  State state() const noexcept override { return device_->state(); }
  std::optional<std::size_t> readings_left() const noexcept override { return device_->readings_left(); }

 private:
  std::unique_ptr<Device> device_;
  float peak_;
};

}  // namespace forceshade::device
