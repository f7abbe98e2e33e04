// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Stands between the law and the device, and lets no force pass that the device, the hand or common sense forbids. Rules
// either limit a force or trip: then the force is zero from that tick on, until the user says otherwise. The table of rules
// with their defaults and sources: docs/safety.md, "Supervisor".

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "device/device.h"
#include "device/hand_speed.h"
#include "device/oscillation.h"
#include "device/simulated/motor.h"
#include "rendering/law.h"

namespace forceshade::device {

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
  double forgiven = 100;                              // mJ, in all: PassivityAccount::forgiven
  int held_ticks = 3;                                 // ticks in a row that may be late, with the force held
  double ramp_down = 0.02;                            // s, over which it then falls to zero
  double watchdog_timeout = 0.02;                     // s: the latest that a tick may be, and the longest that all may be
  double felt_free = 0.05;                            // s in free space before there is any force
  double ramp_up = 0.5;                               // s, over which it then grows
  std::optional<int> dead_man_button = std::nullopt;  // to be held down, else there is no force
  bool acts_on_lateness = true;                       // false: a late tick neither limits a force nor trips
};

SupervisorLimits supervisor_limits(const Capabilities& capabilities, double rate) noexcept;

struct Trip {
  Rule rule;
  std::size_t tick;  // of those supervised, from 0
};

struct Verdict {
  Eigen::Vector3f force{0, 0, 0};  // N, what to command
  Rules limited = {};              // what altered it this tick
  std::optional<Rule> trip = std::nullopt;
};

class Supervisor {
 public:
  // rate: of the ticks, in Hz.
  Supervisor(const SupervisorLimits& limits, double rate) noexcept;

  // Once a tick. `desired` and `status` are the law's, at the reading's position; `late` is by how many seconds the tick began
  // after it was due; `unfinished` as fast::Evaluation has it.
  Verdict supervise(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status, double late,
                    bool unfinished = false) noexcept;

  // What was in the end commanded this tick, where that is not the verdict's force, and what the account has forgiven so far,
  // in mJ. The next tick's rules go by what the hand was given: by what the device says it sent or, where it says nothing, by
  // this.
  void commanded(const Eigen::Vector3f& force, double forgiven = 0) noexcept;

  std::optional<Trip> tripped() const noexcept { return trip_; }

  // The user's word after a trip. Starts gently again; motors stay as warm, and counts as high, as they were.
  void rearm() noexcept;

  // The number of ticks in which a rule limited, or of times that it tripped.
  std::size_t count(Rule rule) const noexcept { return counts_[static_cast<std::size_t>(rule)]; }

 private:
  std::optional<Rule> trip_rule(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status,
                                double late) noexcept;
  Eigen::Vector3f felt(const Reading& reading) const noexcept;
  bool is_frozen(double step, double elapsed, const Eigen::Vector3f& felt) noexcept;
  Eigen::Vector3f limited(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status,
                          Rules& rules) noexcept;
  double start_ramp(Status status) noexcept;
  double workspace_fade(const Eigen::Vector3f& position) const noexcept;
  int ticks_in(double seconds) const noexcept;

  SupervisorLimits limits_;
  double period_;  // s
  Motor motor_;    // all motors as one at the tip, whose torque is the force

  std::size_t tick_ = 0;
  std::optional<Trip> trip_;
  std::array<std::size_t, kRules> counts_{};
  Heat heat_;
  OscillationWatch oscillation_;
  double forgiven_ = 0, excused_ = 0;  // mJ; of that, what rearm() excused

  // What rearm() forgets.
  struct Memory {
    Eigen::Vector3f force{0, 0, 0};           // commanded last
    Eigen::Vector3f punctual_force{0, 0, 0};  // commanded last in a tick that was neither late nor unfinished
    std::optional<Eigen::Vector3f> position;
    double time = 0;                       // s, by the device's clock
    double late = 0;                       // s, the last tick
    int late_ticks = 0;                    // in a row, or unfinished ...
    Rule behind = Rule::missed_deadlines;  // ... which the last one of them was
    int still_ticks = 0;                   // in a row, under force
    int changed_ticks = 0;                 // in a row of those, since the force has changed
    bool was_fast = false;                 // the last step that was one
    Eigen::Vector3f still_force{0, 0, 0};  // when the stillness began
    int free_ticks = 0;                    // in a row, until free space counts as felt
    int gentle_ticks = 0;                  // since
  } memory_;
};

}  // namespace forceshade::device
