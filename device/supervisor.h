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

#include "device/hand_speed.h"
#include "device/oscillation.h"
#include "device/simulated/motor.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

SupervisorLimits supervisor_limits(const Capabilities& capabilities, double rate) noexcept;

struct Verdict {
  Eigen::Vector3f force{0, 0, 0};  // N, what to command
  Rules limited = {};              // the rules that altered it this tick
  std::optional<Rule> trip = std::nullopt;
};

class Supervisor {
 public:
  // rate: of the ticks, in Hz.
  Supervisor(const SupervisorLimits& limits, double rate) noexcept;

  // Once a tick. `desired` and `status` are the law's, at the reading's position; `late` is by how many seconds the tick began
  // after it was due.
  Verdict supervise(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status,
                    double late) noexcept;

  // Takes the force that was in the end commanded, where it is not the verdict's, and PassivityAccount::owed(), in mJ. The
  // next tick's rules go by what the hand was given: by what the device says it sent or, where it says nothing, by this.
  void commanded(const Eigen::Vector3f& force, double owed = 0) noexcept;

  std::optional<Trip> tripped() const noexcept { return trip_; }

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
  double owed_ = 0;  // mJ

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
    Eigen::Vector3f still_force{0, 0, 0};  // at the beginning of the stillness
    int free_ticks = 0;                    // in a row, until free space counts as felt
    int gentle_ticks = 0;                  // since
  } memory_;
};

}  // namespace forceshade::device
