// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs a renderer on a device at a fixed rate. A tick: position, force, supervisor, passivity controller, command.
//
//   const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
//   device::Replay hand({{{3, 0, -1}, 0.0}, {{3, 0, -2}, 0.001}});  // mm, s
//   const std::atomic<bool> stop = false;
//   const device::ServoResult run = device::run_servo_loop(hand, law, {.paced = false}, stop);
//   std::printf("%zu ticks, at most %g N\n", run.ticks, run.peak_force_N);
//
// Lengths are in mm, forces in N, energies in mJ, times in s unless a name ends in another unit. The rate is 100 to 10 000 Hz.
//
// Errors: run_servo_loop() throws before the first reading alone; afterwards ServoResult::end_reason says how it ended.
//
// Threads: the calling thread runs the loop and owns the device, the session and the sinks until it returns; `stop` may be set
// by any thread or a signal handler.
//
// Not promised: that every tick is punctual, which the system decides (docs/device.md); that the supervisor makes an unsafe
// device safe (docs/safety.md says what it limits, and the source of each limit). run.h runs only what a certificate covers,
// and records it.

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/device.h"
#include "forceshade/placement.h"
#include "forceshade/session.h"

namespace forceshade::device {

// One tick as a recording keeps it. Position and forces are in the frame of the law or map, which is the device's unless it was
// placed elsewhere (Placement).
//
// Its bytes are a recording's format: run/recorder/layout.h lists them, and a change of them raises the version there.
struct Sample {
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  static constexpr std::int64_t kNoCount = std::numeric_limits<std::int64_t>::min();  // from a device that shows no encoders
  static constexpr std::uint8_t kEnd = 3;

  std::uint64_t tick = 0;
  std::int64_t wall_ns = 0;                                              // since the loop started, position read
  double device_time = 0;                                                // s, by the device's own clock
  std::array<std::int64_t, 3> encoder = {kNoCount, kNoCount, kNoCount};  // counts, as the device gives them
  double energy = 0;                                                     // mJ, given to the hand less taken from it, so far
  std::int64_t compute_ns = 0;                                           // from position read to force commanded
  std::int64_t wakeup_ns = 0;                                            // from due to awake; 0 if nothing was due
  std::array<float, 3> position = {kUnknown, kUnknown, kUnknown};        // mm
  std::array<float, 3> law_force = {0, 0, 0};                            // N, as the law has it, damped
  std::array<float, 3> force = {0, 0, 0};                                // N, as commanded
  std::array<float, 3> gimbal = {kUnknown, kUnknown, kUnknown};          // rad
  std::uint16_t buttons = 0;                                             // bit k is set while button k is down
  std::uint16_t limited = 0;  // bit Rules::bit_of(rule) is set if this rule of the supervisor changed the law's force
  std::uint8_t status = 0;    // free 0, contact 1, invalid 2; kEnd for the zero force that ends a run
  std::uint8_t late = 0;      // 1 if the force was commanded after the next tick was due
  std::uint8_t altered = 0;   // 1 if the passivity controller changed the supervisor's force
  std::uint8_t tripped = 0;   // the rule that stopped the run, from 1; 0 for none

  // The members from here on are new in format 4: with these the commanded force can be computed again (device/retrace.h).
  std::uint64_t shown = 0;                       // fast::Session::shown()
  double sent_work = 0;                          // mJ, Sent::work
  std::array<float, 3> sent_acted = {0, 0, 0};   // N, in the device's own frame, as the next
  std::array<float, 3> sent_acting = {0, 0, 0};  // N
  float temperature = 0;                         // State::temperature
  std::uint32_t device_state = 0;                // kCalibrated and so on, of this reading
  static constexpr std::uint32_t kCalibrated = 1, kForcesOn = 2, kReportsSent = 4, kUnfinished = 8;
  static constexpr unsigned kPeriodsBit = 8;  // from here on, of a damped run: the periods since the tick before, at most 17

  std::uint32_t periods() const noexcept { return device_state >> kPeriodsBit; }

  // The law's answer of the tick, unless that is the end.
  Status law_status() const noexcept {
    return (device_state & kUnfinished) != 0 ? Status::unfinished : static_cast<Status>(status);
  }
};
static_assert(sizeof(Sample) == 176 && std::is_trivially_copyable_v<Sample>);

// push() is called from the servo loop: it must neither wait nor allocate.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void push(const Sample& sample) noexcept = 0;
};

// The last moments of a run, kept while it runs, for when it ends badly.
class LastSamples final : public SampleSink {
 public:
  // The last sample, and those of so many seconds before it at this rate (Hz). Allocates here and nowhere else.
  LastSamples(double seconds, double rate);

  // The zero force that ends a run is not kept.
  void push(const Sample& sample) noexcept override;

  // The samples in order, oldest first. Not to be called during the run.
  std::vector<Sample> samples() const;

 private:
  std::vector<Sample> ring_;
  std::size_t pushed_ = 0;
};

// The rules by which the supervisor limits a force or trips: docs/safety.md has the table, with defaults and sources.
enum class Rule : std::uint8_t {
  // These limit.
  peak_force,
  continuous_force,
  warm_motors,
  slew,
  workspace,
  gentle_start,
  dead_man,
  // This limits at first, then trips.
  missed_deadlines,
  // These trip.
  invalid_position,
  uncalibrated,
  invalid_force,
  jump,
  velocity,
  frozen_encoder,
  watchdog,
  // This limits; it is the last that has a bit in a Rules.
  oscillation,
  // This trips.
  energy,
  // This limits at first, then trips.
  unfinished,
};
inline constexpr std::size_t kRules = static_cast<std::size_t>(Rule::unfinished) + 1;

std::string_view name_of(Rule rule) noexcept;

// A set of rules that limit.
class Rules {
 public:
  // The bit of a rule in Sample::limited: bit k for rule k, which recordings rely on. The last rule has the bit of a rule that
  // only trips.
  static constexpr unsigned bit_of(Rule rule) noexcept {
    return static_cast<unsigned>(rule == Rule::unfinished ? Rule::watchdog : rule);
  }
  static constexpr bool limits(Rule rule) noexcept {
    return rule <= Rule::missed_deadlines || rule == Rule::oscillation || rule == Rule::unfinished;
  }

  void add(Rule rule) noexcept { bits_ = static_cast<std::uint16_t>(bits_ | bit(rule)); }
  bool has(Rule rule) const noexcept { return (bits_ & bit(rule)) != 0; }
  bool none() const noexcept { return bits_ == 0; }
  std::uint16_t bits() const noexcept { return bits_; }

 private:
  static std::uint16_t bit(Rule rule) noexcept {
    return limits(rule) ? static_cast<std::uint16_t>(1U << bit_of(rule)) : std::uint16_t{0};
  }
  std::uint16_t bits_ = 0;
};

// The highest speed of a hand, mm/s: it tells a hand from a device that runs away or an encoder that fails.
// Under force. The hand feels for something, at some 100 mm/s; a stylus that slipped out of it and is thrown is faster.
inline constexpr double kFastestUnderForce = 1000;

// Anywhere: half a metre, the diagonal of the largest workspace, reached for in 0.2 s. A hand that reaches as smoothly as it
// can (Flash and Hogan 1985) is 15/8 times as fast in the middle as on average: 4.7 m/s.
inline constexpr double kFastest = 5000;

// Infinite or empty: not limited. Why each default is what it is: docs/safety.md.
struct SupervisorLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double peak_force = kNone, continuous_force = kNone;  // N
  double slew = 1000;                                   // N/s, by which a force may grow or turn; it falls at once
  Eigen::Vector3f workspace_low = Eigen::Vector3f::Constant(-Capabilities::kNone);
  Eigen::Vector3f workspace_high = Eigen::Vector3f::Constant(Capabilities::kNone);  // mm
  double workspace_margin = 10;                       // mm outside the workspace, over which the force falls to zero
  double resolution = 0;                              // mm; 0: not an encoder, which cannot freeze
  double speed_under_force = kFastestUnderForce;      // mm/s
  double speed = kFastest;                            // mm/s
  double frozen = 0.02;                               // s without a change of any bit of the position ...
  double frozen_speed = 100;                          // ... mm/s, right after a step as fast as this
  double frozen_force = 0.5;                          // ... or N, after the force has changed by as much
  double energy = 100;                                // mJ: the most that a hand may owe, PassivityAccount::owed()
  int held_ticks = 3;                                 // ticks in a row that may be late, with the force held
  double ramp_down = 0.02;                            // s, over which it then falls to zero
  double watchdog_timeout = 0.02;                     // s: the latest that a tick may be, and the longest that all may be
  double felt_free = 0.05;                            // s in free space before there is any force
  double ramp_up = 0.5;                               // s, over which it then grows
  std::optional<int> dead_man_button = std::nullopt;  // to be held down, else there is no force
  bool acts_on_lateness = true;                       // false: a late tick neither limits a force nor trips
};

struct Trip {
  Rule rule;
  std::size_t tick;  // of those supervised, from 0
};

// The means against a hand's getting more energy out of the force than it put in.
enum class Passivity {
  observer,  // keeps the account and alters nothing
  tank,      // shortens the force and keeps its direction
  damping,   // takes away force along the motion (Hannaford and Ryu 2002, series), and shortens only near the bound
};

std::string_view name_of(Passivity passivity) noexcept;

struct PassivitySettings {
  double longest_step = 1;  // mm, between two readings: s
  double epsilon = 1;       // mJ: what the hand may be given beyond what it put in
  // N: the least Coulomb friction of the device at its tip. What it takes from a motion the hand is not given; it is set
  // against what the hand owes, and never saved. Less than the true one: a path seen in encoder counts is a little too long.
  double friction = 0;
  bool latency = false;   // as in Capabilities
  double period = 0.001;  // s, between two readings
};

// Energies in mJ of the forces as they acted: F(j-1)·(x(j) - x(j-1)), by the device's frames or, where it does not report
// them, by the readings.
// Doubles as they are: 600'000 ticks of an account within ±1 J round it by less than 1e-7 mJ.
struct PassivityAccount {
  double balance = 0;     // put in by the hand, less what it was given; with what friction dissipated and what was written off
  double dissipated = 0;  // by friction in the arm, which the account counts as taken from the hand
  double forgiven = 0;    // of what steps longer than the longest took beyond epsilon
  double lowest_balance = 0;  // never below -epsilon while no step under force was longer than the longest
  double given = 0;           // the part of the balance that went to the hand, counted positive
  double withheld = 0;        // the energy of the desired force in the same steps, less what was given
  double longest_step = 0;    // mm, seen
  double largest_change = 0;  // N: the farthest that a force was altered
  std::size_t altered = 0;    // ticks

  double net() const noexcept { return dissipated + forgiven - balance; }  // given to the hand, less taken from it
  double taken() const noexcept { return given - net(); }

  // The energy that the hand was given beyond what it put in, less what the arm's friction took; also without passivity
  // control.
  double owed() const noexcept { return forgiven + (balance < 0 ? -balance : 0); }
};

// The work of a renderer's damped force on the hand, before supervisor and controller: each force is held until the next tick.
// In three parts that sum up to it (docs/damping.md), mJ. Computed in binary64; `recording check` does it exactly.
struct DampedEnergy {
  double spring = 0;    // of the force without damping
  double damper = 0;    // of the damping at its own velocity; never positive but for a rounding
  double sampling = 0;  // of the damping for that the hand did not go at that velocity
  double most = 0;      // that damper and sampling can give together along this path; NaN after a late or invalid tick
};

// The privileges that were requested and granted; all for the calling thread, but for the memory.
struct Privileges {
  bool scheduling = false;  // SCHED_FIFO
  bool memory_locked = false;
  std::optional<int> cpu;  // the one it is pinned to
};

// Durations in µs; percentiles by nearest rank, at most 1/32 too high. All zero if nothing was counted.
struct Durations {
  double p50 = 0, p99 = 0, p999 = 0, p9999 = 0;
  double max = 0;  // exact
  struct Bucket {
    double up_to;  // µs
    std::uint64_t count;
  };
  std::vector<Bucket> histogram;  // those that are not empty, in order
};

inline constexpr double kLowestRateHz = 100;
inline constexpr double kHighestRateHz = 10000;
inline constexpr double kLongestWatchdogTimeout = 10;  // s

struct ServoOptions {
  double rate_hz = 1000;  // in [kLowestRateHz, kHighestRateHz]

  // Counted in ticks at that rate; none: until the device ends or someone stops it.
  std::optional<double> max_seconds = std::nullopt;

  // False: each tick follows the last at once, and there are no deadlines to miss.
  bool paced = true;

  // True: a tick of a paced loop follows each frame of a device that has frames (Capabilities::paces), so that no position is
  // seen twice and none is missed where two clocks drift. False: this machine's clock, as for any other device.
  bool follows_device = true;

  // The processor to run on when paced; none: the last that its thread may run on.
  std::optional<int> cpu = std::nullopt;

  // A device that can push is supervised and kept passive; one that cannot (Capabilities::peak_force) is only observed, and
  // commanded the law's force as it is.
  Passivity passivity = Passivity::damping;

  // s, as in SupervisorLimits; none: 20 ms, or five periods if longer, and on a device that moves no arm
  // (Capabilities::moves_an_arm) late ticks are only counted.
  std::optional<double> watchdog_timeout = std::nullopt;

  // To be held down, else there is no force.
  std::optional<int> dead_man_button = std::nullopt;

  // The place of the law or map. The device, the supervisor and the passivity controller keep to the device's frame; the law is
  // given the position in its own frame, rounded, and the samples hold that position, and forces, in the law's frame.
  Placement placement = {};

  // Behind the session and in its frame; its rate is that of the loop, whatever stands here. A tick that came late, or a frame
  // that was missed, counts as the periods that passed.
  damping::Parameters damping = {};
  damping::Parameters damping_at_rate() const noexcept { return damping::Described{damping}.at(rate_hz); }

  // Each given every tick as it happens, and the zero force that ends the run.
  std::vector<SampleSink*> sinks = {};
};

// The settings of the supervisor and the passivity controller, fixed before a run: with these and its samples, every command
// of the run can be computed again (device/retrace.h).
struct SafetySettings {
  double rate_hz = 1000;
  bool supervised = false;    // the device can push
  SupervisorLimits limits{};  // of no use where it is not supervised
  Passivity passivity = Passivity::observer;
  PassivitySettings passivity_settings{};
};

// The settings of a run with these options on such a device.
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
  std::size_t unfinished_ticks = 0;   // Status::unfinished
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
  std::size_t forces_off_ticks = 0;                 // in which the device's own forces were off
  const char* forces_off = nullptr;                 // if they were off in the last tick: State::forces_off
  int fades = 0;                                    // these two as Sent has them
  double faded = 0;                                 // s

  Passivity passivity = Passivity::observer;
  PassivitySettings passivity_settings;
  PassivityAccount account;
  double energy_given_mJ() const noexcept { return account.given; }
  double energy_taken_mJ() const noexcept { return account.taken(); }

  damping::Parameters damping;  // off where the run had none
  DampedEnergy damped_energy;

  bool followed_device = false;  // as ServoOptions says, and the device paces
  Privileges privileges;         // requested only when paced
};

// Ticks are due at start + k/rate; a late tick is run at once and the schedule kept, so a stall is caught up with. Where they
// follow the device's frames, a tick is due when its frame begins, and frames that a stall missed stay missed.
// `stop` may be set by a signal handler or another thread. However the run ends, the last command is zero force; once a rule
// of the supervisor tripped, so is that very tick's, and only another call starts again.
// Between the first reading and that command nothing is allocated, locked, written or thrown.
// Before them, throws Error under a fast::arithmetic_fault(), which would void every proof about the fast path, and
// std::invalid_argument for an option out of range or a device that does not report its limits.
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
