// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/passivity.h"

#include <algorithm>
#include <utility>

#include "forceshade/device/hand_speed.h"
#include "forceshade/device/shortened.h"

namespace forceshade::device {

PassivitySettings passivity_settings(const Capabilities& capabilities, double rate) noexcept {
  constexpr double kStiffest = 1;  // N/mm: more than can be rendered on the devices there are
  const double step = longest_step(kFastestUnderForce, 1 / rate, static_cast<double>(capabilities.resolution));
  const double ahead = capabilities.latency ? 2 * step : step;
  return {.longest_step = step,
          .epsilon = kStiffest * ahead * ahead,
          .friction = static_cast<double>(capabilities.friction) / 2,
          .latency = capabilities.latency};
}

std::string_view name_of(PassivityController::Kind kind) noexcept {
  switch (kind) {
    case PassivityController::Kind::observer: return "observer";
    case PassivityController::Kind::tank: return "tank";
    case PassivityController::Kind::damping: break;
  }
  return "damping";
}

Eigen::Vector3f PassivityController::passed(const Eigen::Vector3f& position, const Eigen::Vector3f& wanted) noexcept {
  const bool valid = position.allFinite() && wanted.allFinite();
  const Eigen::Vector3d here = position.cast<double>();
  Eigen::Vector3d step{0, 0, 0};
  if (valid && last_position_) {
    step = here - *last_position_;
    settle(step, settings_.friction);
  } else {
    // Not seen: the longest step straight along the force, and no friction.
    settle(acting_.force.stableNormalized() * settings_.longest_step, 0);
  }
  last_position_ = valid ? std::optional(here) : std::nullopt;
  Commanded commanded;
  if (settings_.latency) acting_ = std::exchange(pending_, {});
  Eigen::Vector3f force = valid ? limited(wanted, step) : Eigen::Vector3f::Zero();
  if (valid) commanded = {wanted.cast<double>(), force.cast<double>()};
  (settings_.latency ? pending_ : acting_) = commanded;
  const double change = (commanded.force - commanded.wanted).norm();
  if (change > 0) ++account_.altered;
  account_.largest_change = std::max(account_.largest_change, change);
  return force;
}

void PassivityController::settle(const Eigen::Vector3d& step, double friction) noexcept {
  const double given = acting_.force.dot(step);
  account_.balance -= given;
  const double rubbed = std::min(friction * step.norm(), std::max(0.0, -account_.balance));
  account_.balance += rubbed;
  account_.rubbed += rubbed;
  account_.lowest_balance = std::min(account_.lowest_balance, account_.balance);
  account_.given += std::max(given, 0.0);
  account_.withheld += acting_.wanted.dot(step) - given;
  account_.longest_step = std::max(account_.longest_step, step.norm());
}

Eigen::Vector3f PassivityController::limited(const Eigen::Vector3f& wanted, const Eigen::Vector3d& step) const noexcept {
  if (kind_ == Kind::observer) return wanted;
  // Room for rounding, that to binary32 included: g++ 12 at -O3 was seen to take the length of a vector before it.
  constexpr double kRoom = 0x1p-22;
  const double worst_step = settings_.longest_step * (1 + kRoom);
  const Eigen::Vector3d committed = settings_.latency ? acting_.force : Eigen::Vector3d::Zero();
  double credit = account_.balance + settings_.epsilon - committed.norm() * worst_step;

  // While the hand goes as it went, half of epsilon is spent and no more. The other half is for a hand that turns, and lets
  // it have force again once it pushes: from an empty account it could put nothing in.
  const double reserve = settings_.epsilon / 2;
  const double expected = wanted.cast<double>().dot(step);
  Eigen::Vector3f force = wanted;
  if (expected > 0 && kind_ == Kind::tank) credit -= reserve;
  if (expected > 0 && kind_ == Kind::damping) {
    // At most as much as turns the force along the motion round: what is owed is paid back, with no longer force.
    const double excess = expected - (account_.balance + reserve - committed.dot(step));
    const double taken = std::clamp(excess, 0.0, 2 * expected);
    if (taken > 0) force = ((wanted.cast<double>() - step * (taken / step.squaredNorm())) * (1 - kRoom)).cast<float>();
  }
  return shortened(force, std::max(credit, 0.0) / worst_step);
}

}  // namespace forceshade::device
