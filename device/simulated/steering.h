// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The target of a simulated hand, set by another thread while it moves: a mouse for a person without a PHANToM.

#include <Eigen/Core>

#include "device/simulated/hand.h"
#include "device/triple_buffer.h"

namespace forceshade::device {

// A mouse moves in leaps, sixty a second, and a hand does not. The hand goes after the place aimed at like a critically damped
// mass (30/s: within a twentieth of its way after 0.16 s), no faster than kFastestSteered. No thread ever waits.
class Steering {
 public:
  // mm/s, below the speeds at which a supervisor trips.
  static constexpr double kFastestSteered = 400;

  // The hand begins here, in mm in the laws' frame.
  explicit Steering(const Eigen::Vector3d& start = {0, 0, 20}) noexcept;

  // Sets where the hand is to go, mm; called by one thread. A position that is not finite is ignored.
  void aim(const Eigen::Vector3d& position) noexcept;

  // Called by the device before its first reading: aims outside the box from -reach to reach (mm) count as its nearest place.
  void stay_within(const Eigen::Vector3d& reach) noexcept;

  // Called by the device: where the hand means to be `period` s after the last call, which is its start at the first.
  Target next(double period) noexcept;

 private:
  struct Aim {
    Eigen::Vector3d position{0, 0, 0};
    bool is_given = false;
  };
  Eigen::Vector3d kept_within(const Eigen::Vector3d& position) const noexcept;

  TripleBuffer<Aim> mailbox_;
  Eigen::Vector3d reach_;
  Target hand_;
  bool has_begun_ = false;
};

}  // namespace forceshade::device
