// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs a law or a height map on a device at a fixed rate. A tick: position, force, supervisor, passivity controller, command.

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "device/device.h"
#include "device/passivity_controller.h"
#include "device/placement.h"
#include "device/real_time.h"
#include "device/sample.h"
#include "device/supervisor.h"
#include "device/timing.h"
#include "fast/session.h"

namespace forceshade::device {

inline constexpr double kLowestRateHz = 100;
inline constexpr double kHighestRateHz = 10000;
inline constexpr double kLongestWatchdogTimeout = 10;  // s

struct ServoOptions {
  double rate_hz = 1000;  // in [kLowestRateHz, kHighestRateHz]

  // Counted in ticks at that rate; none: until the device ends or someone stops it.
  std::optional<double> max_seconds = std::nullopt;

  // False: each tick follows the last at once, and there are no deadlines to miss.
  bool paced = true;

  // When paced: a tick follows each frame of a device that has frames of its own (Capabilities::paces), so that no position is
  // seen twice and none is missed where two clocks drift. False: this machine's clock, as for any other device.
  bool follows_device = true;

  // The processor to run on when paced; none: RealTime chooses.
  std::optional<int> cpu = std::nullopt;

  // A device that can push is supervised and kept passive; one that cannot (Capabilities::peak_force) is only observed, and
  // commanded the law's force as it is.
  PassivityController::Kind passivity = PassivityController::Kind::damping;

  // s, as in SupervisorLimits; none: 20 ms, or five periods if longer, and on a device that moves no arm
  // (Capabilities::moves_an_arm) late ticks are only counted.
  std::optional<double> watchdog_timeout = std::nullopt;

  // To be held down, else there is no force.
  std::optional<int> dead_man_button = std::nullopt;

  // Where the law or map lies. The device, the supervisor and the passivity controller keep to the device's frame; the law is
  // given the position in its own frame, rounded, and the samples hold that position, and forces, in the law's frame.
  Placement placement = {};

  // Each given every tick as it happens, and the zero force that ends the run.
  std::vector<SampleSink*> sinks = {};
};

// What the supervisor and the passivity controller go by, fixed before a run: with these and its samples, every command of the
// run can be computed again (device/retrace.h).
struct SafetySettings {
  double rate_hz = 1000;
  bool supervised = false;    // the device can push
  SupervisorLimits limits{};  // of no use where it is not supervised
  PassivityController::Kind passivity = PassivityController::Kind::observer;
  PassivitySettings passivity_settings{};
};

// Those of a run with these options on such a device.
SafetySettings safety_settings(const Capabilities& capabilities, const ServoOptions& options) noexcept;

enum class EndReason { end_of_data, time_up, stopped, tripped, device_fault };

std::string_view name_of(EndReason reason) noexcept;

// The tick of a run that began the longest time after it was due, and what the tick before it took: a tick begins late because
// the system woke the loop late, or because the tick before took longer than a period.
struct Delay {
  std::size_t tick = 0;
  double late_ms = 0;      // 0 where every tick began in time, or nothing was due
  double before_ms = 0;    // of the tick before, from awake to force commanded
  double computed_ms = 0;  // of that, what this thread computed
};

struct ServoResult {
  EndReason end_reason = EndReason::stopped;
  const char* fault = "";    // the device's words if end_reason is device_fault
  std::optional<Trip> trip;  // if end_reason is tripped

  std::size_t ticks = 0;
  std::size_t missed_deadlines = 0;   // ticks whose force was commanded after the next tick was due
  std::size_t overruns = 0;           // those of them that computed for longer than a period, by processor time: our own fault
  std::size_t invalid_positions = 0;  // ticks where the law refused the position; the force was zero
  std::size_t unfinished_ticks = 0;   // fast::Evaluation::is_unfinished
  double achieved_rate_hz = 0;        // ticks over the time they took
  Delay worst_delay;
  bool acts_on_lateness = true;  // this and the next as SupervisorLimits has them
  double watchdog_timeout = 0;   // s
  Durations wakeup_us;           // from due to awake; none if not paced
  Durations compute_us;          // from position read to force commanded
  Durations tick_us;             // from awake to force commanded: with what the device took to be read
  double peak_force_N = 0;

  bool supervised = false;                          // the device can push
  std::array<std::size_t, kRules> limited_ticks{};  // in how many ticks each rule of the supervisor changed the force

  PassivityController::Kind passivity = PassivityController::Kind::observer;
  PassivitySettings passivity_settings;
  PassivityAccount account;
  double energy_given_mJ() const noexcept { return account.given; }
  double energy_taken_mJ() const noexcept { return account.taken(); }

  bool followed_device = false;  // as ServoOptions says, and the device paces
  Privileges privileges;         // requested only when paced
};

// fast::arithmetic_fault() found one: every proof about the fast path would be void.
struct FloatingPointModeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ticks are due at start + k/rate; a late tick is run at once and the schedule kept, so a stall is caught up with. Where they
// follow the device's frames, a tick is due when its frame begins, and frames that a stall missed stay missed.
// `stop` may be set by a signal handler or another thread. However the run ends, the last command is zero force; once a rule
// of the supervisor tripped, so is that very tick's, and only another call starts again.
// Between the first reading and that command nothing is allocated, locked, written or thrown.
// Before them, throws FloatingPointModeError, or std::invalid_argument for an option out of range or a device that does not
// report its limits.
ServoResult run_servo_loop(Device& device, fast::Session& session, const ServoOptions& options, const std::atomic<bool>& stop);

// The session of a law or a height map.
template <class Field>
requires requires(const Field& field) {
  field.evaluate(Eigen::Vector3f());
}
ServoResult run_servo_loop(Device& device, const Field& field, const ServoOptions& options, const std::atomic<bool>& stop) {
  fast::FieldSession<Field> session(field);
  return run_servo_loop(device, static_cast<fast::Session&>(session), options, stop);
}

}  // namespace forceshade::device
