// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulated/steering.h"

#include <cmath>
#include <limits>

namespace forceshade::device {

Steering::Steering(const Eigen::Vector3d& start) noexcept
    : reach_(Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())), hand_{.position = start} {}

void Steering::aim(const Eigen::Vector3d& position) noexcept {
  if (position.allFinite()) mailbox_.publish({position, true});
}

void Steering::stay_within(const Eigen::Vector3d& reach) noexcept {
  reach_ = reach;
  hand_.position = kept_within(hand_.position);
}

Eigen::Vector3d Steering::kept_within(const Eigen::Vector3d& position) const noexcept {
  return position.cwiseMax(-reach_).cwiseMin(reach_);
}

Target Steering::next(double period) noexcept {
  constexpr double kPulsation = 30;  // 1/s
  if (!has_begun_) {
    has_begun_ = true;
    return hand_;
  }
  const Aim& aim = mailbox_.latest();
  if (!aim.is_given) return hand_;
  // The exact motion of the critically damped mass over a period in which the aim rests.
  const Eigen::Vector3d there = kept_within(aim.position), away = hand_.position - there;
  const Eigen::Vector3d drift = hand_.velocity + kPulsation * away;
  const double decay = std::exp(-kPulsation * period);
  Eigen::Vector3d step = there + decay * (away + period * drift) - hand_.position;
  hand_.velocity = decay * (hand_.velocity - kPulsation * period * drift);
  if (const double longest = kFastestSteered * period; step.norm() > longest) {
    step *= longest / step.norm();
    hand_.velocity = step / period;
  }
  hand_.position += step;
  return hand_;
}

}  // namespace forceshade::device
