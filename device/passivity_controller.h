// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keeps a hand from getting more energy out of the force than it put in, whatever the law: force shading gives
// K D w²/8R for every stroke outward. The bound and its proof: docs/safety.md, "Passivity".

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string_view>

#include "device/sent_forces.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

// The settings for a hand no faster than kFastestUnderForce. Epsilon is twice what a wall of 1 N/mm needs in advance, so that
// no softer one is altered when pressed slowly: it needs K δ for the next step (two steps, with latency) when ½K δ² was put
// in. It grows with the square of the period, to half of what the supervisor lets a hand owe and no further. Half of the
// friction of the device's data sheet is counted.
PassivitySettings passivity_settings(const Capabilities& capabilities, double rate) noexcept;

class PassivityController {
 public:
  explicit PassivityController(const PassivitySettings& settings, Passivity kind = Passivity::damping) noexcept;

  // Once a tick, last before the device: what to command at this reading instead of `desired` (N). Never longer than `desired`.
  // Zero if the position or the force is not finite.
  Eigen::Vector3f limited(const Reading& reading, const Eigen::Vector3f& desired) noexcept;

  // The energy that the device may give from now on: with it the bound holds however late the next tick is.
  Allowance allowance() const noexcept;

  const PassivityAccount& account() const noexcept { return account_; }

 private:
  void settle(const Sent& sent, const Eigen::Vector3d& step) noexcept;
  Eigen::Vector3d shaped(const Eigen::Vector3d& desired) const noexcept;
  double left() const noexcept { return account_.balance + settings_.epsilon; }

  PassivitySettings settings_;
  Passivity kind_;
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

}  // namespace forceshade::device
