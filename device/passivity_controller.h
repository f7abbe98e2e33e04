// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keeps a hand from getting more energy out of the force than it put in, whatever the law: force shading gives
// K D w²/8R for every stroke outward. The bound and its proof: docs/safety.md, "Passivity".

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>

#include "device/device.h"
#include "device/sent_forces.h"

namespace forceshade::device {

struct PassivitySettings {
  double longest_step = 1;  // mm, between two readings: s
  double epsilon = 1;       // mJ: what the hand may be given beyond what it put in
  // N: the least Coulomb friction of the device at its tip. What it takes from a motion the hand is not given; it is set
  // against what the hand owes, and never saved. Less than the true one: a path seen in encoder counts is a little too long.
  double friction = 0;
  bool latency = false;   // as in Capabilities
  double period = 0.001;  // s, between two readings
};

// The settings for a hand no faster than kFastestUnderForce. Epsilon is twice what a wall of 1 N/mm needs in advance, so that
// no softer one is altered when pressed slowly: it needs K δ for the next step (two steps, with latency) when ½K δ² was put
// in. Half of the friction of the device's data sheet is counted.
PassivitySettings passivity_settings(const Capabilities& capabilities, double rate) noexcept;

// Energies in mJ of the forces as they acted: F(j-1)·(x(j) - x(j-1)), by the device's frames or, where it does not report
// them, by the readings.
// Doubles as they are: 600'000 ticks of an account within ±1 J round it by less than 1e-7 mJ.
struct PassivityAccount {
  double balance = 0;     // put in by the hand, less what it was given; with what friction dissipated and what was written off
  double dissipated = 0;  // by friction in the arm, which the account counts as taken from the hand
  double forgiven = 0;    // of what steps longer than the longest took beyond epsilon
  double lowest_balance = 0;  // never below -epsilon while no step under force was longer than the longest
  double given = 0;           // the part of the balance that went to the hand, counted positive
  double withheld = 0;        // what the desired force would have given in the same steps, less what was given
  double longest_step = 0;    // mm, seen
  double largest_change = 0;  // N: the farthest that a force was altered
  std::size_t altered = 0;    // ticks

  double net() const noexcept { return dissipated + forgiven - balance; }  // given to the hand, less taken from it
  double taken() const noexcept { return given - net(); }
};

class PassivityController {
 public:
  enum class Kind {
    observer,  // keeps the account and alters nothing
    tank,      // shortens the force and keeps its direction
    damping,   // takes away force along the motion (Hannaford and Ryu 2002, series), and shortens only near the bound
  };

  explicit PassivityController(const PassivitySettings& settings, Kind kind = Kind::damping) noexcept;

  // Once a tick, last before the device: what to command at this reading instead of `desired` (N). Never longer than `desired`.
  // Zero if the position or the force is not finite.
  Eigen::Vector3f limited(const Reading& reading, const Eigen::Vector3f& desired) noexcept;

  // What the device may give from now on: with it the bound holds however late the next tick is.
  Allowance allowance() const noexcept;

  const PassivityAccount& account() const noexcept { return account_; }

 private:
  void settle(const Sent& sent, const Eigen::Vector3d& step) noexcept;
  Eigen::Vector3d shaped(const Eigen::Vector3d& desired) const noexcept;
  double left() const noexcept { return account_.balance + settings_.epsilon; }

  PassivitySettings settings_;
  Kind kind_;
  PassivityAccount account_;
  SentForces own_;   // of a device that does not report
  double work_ = 0;  // mJ, as of the last reading
  std::optional<Eigen::Vector3d> last_position_;
  Eigen::Vector3d acting_wanted_{0, 0, 0}, pending_wanted_{0, 0, 0};  // since the last reading; from this one on, with latency
  // Smoothed, for the shape of the force and never for its bound: what is left, in mJ, the motion, once and twice, in mm a
  // tick, and the way that the hand came last, no longer than the longest step.
  double left_;
  Eigen::Vector3d step_{0, 0, 0}, motion_{0, 0, 0}, way_{0, 0, 0};
};

std::string_view name_of(PassivityController::Kind kind) noexcept;

}  // namespace forceshade::device
