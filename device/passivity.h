// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keeps a hand from getting more energy out of the force than it put in, whatever the law: force shading gives
// K D w²/8R for every stroke outward. The bound and its proof: docs/device.md, "Passivity".

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>

#include "forceshade/device/device.h"

namespace forceshade::device {

struct PassivitySettings {
  double longest_step = 1;  // mm, between two readings: s
  double epsilon = 1;       // mJ: what the hand may be given beyond what it put in
  // N: the least Coulomb friction of the device at its tip. What it takes from a motion the hand is not given; it is set
  // against what the hand owes, and never saved. Less than the true one: a path seen in encoder counts is a little too long.
  double friction = 0;
  bool latency = false;  // as in Capabilities
};

// For a hand no faster than kFastestUnderForce. Epsilon is twice what a wall of 1 N/mm asks for on credit, so that no softer
// one is altered when pressed slowly: it wants K δ ready for the next step (two steps, with latency) when ½K δ² was put in.
// Of the friction that the device's sheet has, half is counted.
PassivitySettings passivity_settings(const Capabilities& capabilities, double rate) noexcept;

// Energies in mJ of the force as it is held, from reading to reading: f(k-1)·(x(k) - x(k-1)), and f(k-2) with latency.
// Doubles as they are: 600'000 ticks of an account within ±1 J round it by less than 1e-7 mJ.
struct PassivityAccount {
  double balance = 0;         // put in by the hand, less what it was given; with what friction paid
  double rubbed = 0;          // what friction paid
  double lowest_balance = 0;  // never below -epsilon while no step was longer than the longest
  double given = 0;           // the part of the balance that went to the hand, counted positive
  double withheld = 0;        // what the wanted force would have given in the same steps, less what was given
  double longest_step = 0;    // mm, seen
  double largest_change = 0;  // N: the farthest that a force was altered
  std::size_t altered = 0;    // ticks

  double net() const noexcept { return rubbed - balance; }  // given to the hand, less taken from it
  double taken() const noexcept { return given - net(); }
};

class PassivityController {
 public:
  enum class Kind {
    observer,  // keeps the account and alters nothing
    tank,      // shortens the force and keeps its direction
    damping,   // takes away force along the motion (Hannaford and Ryu 2002, series), then shortens where that is not enough
  };

  explicit PassivityController(const PassivitySettings& settings, Kind kind = Kind::damping) noexcept
      : settings_(settings), kind_(kind) {}

  // Once a tick, last before the device: what to command at `position` (mm) instead of `wanted` (N). Never longer than
  // `wanted`. Zero if either is not finite; the account then assumes the worst of the step that was not seen.
  Eigen::Vector3f passed(const Eigen::Vector3f& position, const Eigen::Vector3f& wanted) noexcept;

  const PassivityAccount& account() const noexcept { return account_; }

 private:
  struct Commanded {
    Eigen::Vector3d wanted{0, 0, 0}, force{0, 0, 0};
  };

  void settle(const Eigen::Vector3d& step, double friction) noexcept;
  Eigen::Vector3f limited(const Eigen::Vector3f& wanted, const Eigen::Vector3d& step) const noexcept;

  PassivitySettings settings_;
  Kind kind_;
  PassivityAccount account_;
  std::optional<Eigen::Vector3d> last_position_;
  Commanded acting_, pending_;  // since the last reading; from this one on, with latency
};

std::string_view name_of(PassivityController::Kind kind) noexcept;

}  // namespace forceshade::device
