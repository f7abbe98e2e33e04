// SPDX-License-Identifier: BSD-3-Clause
#include "device/supervisor.h"

#include <algorithm>
#include <cmath>

#include "device/shortened.h"

namespace forceshade::device {
namespace {

// The heat of a Premium's motors (docs/simulation.md, "Dynamics"), with forces in place of torques.
Motor as_one_motor(const SupervisorLimits& limits) noexcept {
  return {.torque_constant = 1,
          .continuous = limits.continuous_force,
          .stall = limits.peak_force,
          .rotor_inertia = 0,
          .winding_time = 12,
          .housing_time = 612,
          .winding_resistance = 3.1,
          .housing_resistance = 14,
          .amplifier_bits = 0};
}

}  // namespace

std::string_view name_of(Rule rule) noexcept {
  switch (rule) {
    case Rule::peak_force: return "peak force";
    case Rule::continuous_force: return "continuous force";
    case Rule::warm_motors: return "warm motors";
    case Rule::slew: return "slew";
    case Rule::workspace: return "workspace";
    case Rule::gentle_start: return "gentle start";
    case Rule::dead_man: return "dead-man switch";
    case Rule::missed_deadlines: return "missed deadlines";
    case Rule::invalid_position: return "invalid position";
    case Rule::uncalibrated: return "uncalibrated";
    case Rule::invalid_force: return "invalid force";
    case Rule::jump: return "jump";
    case Rule::velocity: return "velocity";
    case Rule::frozen_encoder: return "frozen encoder";
    case Rule::watchdog: return "watchdog";
    case Rule::oscillation: return "oscillation";
    case Rule::energy: return "energy";
    case Rule::unfinished: break;
  }
  return "unfinished";
}

SupervisorLimits supervisor_limits(const Capabilities& capabilities, double rate) noexcept {
  SupervisorLimits limits;
  limits.peak_force = static_cast<double>(capabilities.peak_force);
  limits.continuous_force = static_cast<double>(capabilities.continuous_force);
  limits.workspace_low = capabilities.workspace_low;
  limits.workspace_high = capabilities.workspace_high;
  limits.resolution = static_cast<double>(capabilities.resolution);
  limits.speed_under_force = std::min(limits.speed_under_force, capabilities.highest_speed);
  limits.speed = std::min(limits.speed, capabilities.highest_speed);
  limits.slew = std::min(limits.slew, capabilities.highest_slew);
  limits.watchdog_timeout = std::max(limits.watchdog_timeout, 5 / rate);
  return limits;
}

Supervisor::Supervisor(const SupervisorLimits& limits, double rate) noexcept
    : limits_(limits), period_(1 / rate), motor_(as_one_motor(limits)), oscillation_(limits.resolution, period_) {}

Verdict Supervisor::supervise(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status,
                              double late) noexcept {
  if (!limits_.acts_on_lateness) late = 0;
  Verdict verdict;
  const auto trip = [&](Rule rule) {
    trip_ = Trip{rule, tick_};
    ++counts_[static_cast<std::size_t>(rule)];
  };
  if (!trip_) {
    memory_.behind = late > period_ ? Rule::missed_deadlines : Rule::unfinished;
    memory_.late_ticks = late > period_ || status == Status::unfinished ? memory_.late_ticks + 1 : 0;
    if (const auto rule = trip_rule(reading, state, desired, status, late)) trip(*rule);
  }
  if (!trip_) {
    verdict.force = limited(reading, state, desired, status, verdict.limited);
    for (std::size_t i = 0; i < kRules; ++i)
      if (verdict.limited.has(static_cast<Rule>(i))) ++counts_[i];
  }
  if (trip_) verdict.trip = trip_->rule;
  heat_ = heated(motor_, heat_, verdict.force.cast<double>().norm(), period_);
  commanded(verdict.force, owed_);
  memory_.position = reading.position;
  memory_.time = reading.time;
  memory_.late = late;
  ++tick_;
  return verdict;
}

void Supervisor::commanded(const Eigen::Vector3f& force, double owed) noexcept {
  owed_ = owed;
  memory_.force = force;
  if (memory_.late_ticks == 0) memory_.punctual_force = force;
}

Eigen::Vector3f Supervisor::felt(const Reading& reading) const noexcept {
  return reading.sent ? reading.sent->acted : memory_.force;
}

int Supervisor::ticks_in(double seconds) const noexcept {
  return std::max(1, static_cast<int>(std::lround(seconds / period_)));
}

std::optional<Rule> Supervisor::trip_rule(const Reading& reading, const State& state, const Eigen::Vector3f& desired,
                                          Status status, double late) noexcept {
  if (!state.calibrated) return Rule::uncalibrated;
  if (!reading.position.allFinite() || status == Status::invalid) return Rule::invalid_position;
  if (!desired.allFinite()) return Rule::invalid_force;
  if (late > limits_.watchdog_timeout || std::isnan(late)) return Rule::watchdog;
  if (memory_.late_ticks >= std::max(limits_.held_ticks + ticks_in(limits_.ramp_down), ticks_in(limits_.watchdog_timeout)))
    return memory_.behind;
  if (owed_ > limits_.energy) return Rule::energy;
  if (!memory_.position) return std::nullopt;

  // A late tick saw a longer step, and so did one whose device was late by its own clock; a tick that catches up is not held
  // to a shorter one. Nor does a device's clock that leaps excuse any step: more than the watchdog allows has not passed.
  const double by_device = std::min(reading.time - memory_.time, period_ + limits_.watchdog_timeout);
  const double elapsed = std::max(period_ + std::max(0.0, late - memory_.late), by_device);
  const double step = (reading.position.cast<double>() - memory_.position->cast<double>()).norm();
  if (step > longest_step(limits_.speed, elapsed, limits_.resolution)) return Rule::jump;
  const Eigen::Vector3f acted = felt(reading);
  if (!acted.isZero(0) && step > longest_step(limits_.speed_under_force, elapsed, limits_.resolution)) return Rule::velocity;
  if (is_frozen(step, elapsed, acted)) return Rule::frozen_encoder;
  return std::nullopt;
}

// Time alone does not distinguish a frozen encoder from a hand at rest: friction holds a device still for minutes. But no hand
// stops dead from 100 mm/s, within one period and on every axis; and none stays where it was after its force has changed by
// half a newton, which is a millimetre of its flesh.
bool Supervisor::is_frozen(double step, double elapsed, const Eigen::Vector3f& felt) noexcept {
  if (step > 0 || felt.isZero(0) || !(limits_.resolution > 0)) {
    memory_.still_ticks = memory_.changed_ticks = 0;
    memory_.was_fast = step > longest_step(limits_.frozen_speed, elapsed, limits_.resolution);
    return false;
  }
  if (memory_.still_ticks++ == 0) memory_.still_force = felt;
  const double change = (felt - memory_.still_force).cast<double>().norm();
  memory_.changed_ticks = change > limits_.frozen_force ? memory_.changed_ticks + 1 : 0;
  return (memory_.was_fast ? memory_.still_ticks : memory_.changed_ticks) >= ticks_in(limits_.frozen);
}

Eigen::Vector3f Supervisor::limited(const Reading& reading, const State& state, const Eigen::Vector3f& desired, Status status,
                                    Rules& rules) noexcept {
  Eigen::Vector3f force = desired;
  const auto replace = [&](const Eigen::Vector3f& by, Rule rule) {
    if (by != force) rules.add(rule);
    force = by;
  };
  const auto limit = [&](double most, Rule rule) { replace(shortened(force, most), rule); };
  const double gain = oscillation_.next(reading.position, felt(reading));

  const bool held_down =
      !limits_.dead_man_button || (reading.buttons >> static_cast<unsigned>(*limits_.dead_man_button) & 1U) != 0;
  if (!held_down || !state.forces_on) {
    memory_.free_ticks = memory_.gentle_ticks = 0;
    replace(Eigen::Vector3f::Zero(), Rule::dead_man);
    return force;
  }
  replace(force * static_cast<float>(start_ramp(status)), Rule::gentle_start);
  replace(force * static_cast<float>(workspace_fade(reading.position)), Rule::workspace);
  replace(force * static_cast<float>(gain), Rule::oscillation);
  if (memory_.late_ticks > 0) {
    const int ramped = std::max(0, memory_.late_ticks - limits_.held_ticks);
    const double left = std::max(0.0, 1 - ramped / static_cast<double>(ticks_in(limits_.ramp_down)));
    // The ramp of a gentle start gives back what is taken away here.
    memory_.gentle_ticks = std::min(memory_.gentle_ticks, static_cast<int>(left * ticks_in(limits_.ramp_up)));
    const double held = left * memory_.punctual_force.cast<double>().norm();
    replace(shortened(memory_.punctual_force, std::min(held, force.cast<double>().norm())), memory_.behind);
  }
  limit(limits_.peak_force, Rule::peak_force);
  if (std::isfinite(limits_.peak_force) && std::isfinite(limits_.continuous_force)) {
    limit(torque_limit(motor_, heat_), Rule::continuous_force);
    const double temperature = std::isnan(state.temperature) ? 2 : static_cast<double>(state.temperature);
    limit(torque_limit(motor_, {.winding = temperature}), Rule::warm_motors);
  }
  // From the part of the last force that is no longer than the new one: letting go late would push a hand that leaves.
  const double length = force.cast<double>().norm();
  const Eigen::Vector3f from = shortened(memory_.force, length), change = force - from;
  if (change.cast<double>().norm() > limits_.slew * period_)
    replace(shortened(from + shortened(change, limits_.slew * period_), length), Rule::slew);
  return force;
}

double Supervisor::start_ramp(Status status) noexcept {
  const int felt = ticks_in(limits_.felt_free), all = ticks_in(limits_.ramp_up);
  if (memory_.free_ticks < felt) {
    memory_.free_ticks = status == Status::free ? memory_.free_ticks + 1 : 0;
    return 0;
  }
  memory_.gentle_ticks = std::min(all, memory_.gentle_ticks + 1);
  return static_cast<double>(memory_.gentle_ticks) / all;
}

// 1 in the workspace, 0 from the margin on.
double Supervisor::workspace_fade(const Eigen::Vector3f& position) const noexcept {
  const Eigen::Vector3f inside = position.cwiseMax(limits_.workspace_low).cwiseMin(limits_.workspace_high);
  const double outside = (position - inside).cast<double>().norm();
  return outside > 0 ? std::max(0.0, 1 - outside / limits_.workspace_margin) : 1;
}

}  // namespace forceshade::device
