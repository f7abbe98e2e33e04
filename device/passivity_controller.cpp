// SPDX-License-Identifier: BSD-3-Clause
#include "device/passivity_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/hand_speed.h"
#include "device/shortened.h"

namespace forceshade::device {

namespace {

// On its own, because g++ 12 at -O3 was seen to leave out the rounding of a number that is widened again.
[[gnu::noinline]] Eigen::Vector3f rounded(const Eigen::Vector3d& force) noexcept {
  return force.cast<float>();
}

}  // namespace

PassivitySettings passivity_settings(const Capabilities& capabilities, double rate) noexcept {
  constexpr double kStiffest = 1;                            // N/mm: more than can be rendered on the devices there are
  const double most_credit = SupervisorLimits{}.energy / 2;  // mJ
  const double step = longest_step(kFastestUnderForce, 1 / rate, static_cast<double>(capabilities.resolution));
  const double ahead = capabilities.latency ? 2 * step : step;
  return {.longest_step = step,
          .epsilon = std::min(kStiffest * ahead * ahead, most_credit),
          .friction = static_cast<double>(capabilities.friction) / 2,
          .latency = capabilities.latency,
          .period = 1 / rate};
}

std::string_view name_of(Passivity kind) noexcept {
  switch (kind) {
    case Passivity::observer: return "observer";
    case Passivity::tank: return "tank";
    case Passivity::damping: break;
  }
  return "damping";
}

PassivityController::PassivityController(const PassivitySettings& settings, Passivity kind) noexcept
    : settings_(settings), kind_(kind), left_(settings.epsilon) {
  // This class itself shortens the forces that are sent.
  own_.allow({.longest_step = settings.longest_step});
}

Allowance PassivityController::allowance() const noexcept {
  if (kind_ == Passivity::observer) return {};
  return {.work = settings_.epsilon + account_.dissipated + account_.forgiven, .longest_step = settings_.longest_step};
}

Eigen::Vector3f PassivityController::limited(const Reading& reading, const Eigen::Vector3f& desired) noexcept {
  constexpr double kRoom = 0x1p-22;  // for rounding
  const Eigen::Vector3d here = reading.position.cast<double>();
  const bool seen = here.allFinite();
  Eigen::Vector3d step{0, 0, 0}, finite{0, 0, 0};
  if (seen && last_position_) step = here - *last_position_;
  if (seen && desired.allFinite()) finite = desired.cast<double>();
  last_position_ = seen ? std::optional(here) : std::nullopt;
  if (!reading.sent) own_.arrived(here);
  settle(reading.sent.value_or(own_.report()), step);

  Eigen::Vector3f force = rounded(finite);
  if (kind_ != Passivity::observer)
    if (const Eigen::Vector3d left = shaped(finite); left != finite) force = rounded(left * (1 - kRoom));
  if (!reading.sent) {
    if (kind_ != Passivity::observer)
      force = rounded(shortened(force, std::max(left(), 0.0) / (settings_.longest_step * (1 + kRoom))).cast<double>());
    own_.send(force.cast<double>());
  }
  acting_wanted_ = std::exchange(pending_wanted_, finite);
  if (!settings_.latency) acting_wanted_ = finite;
  const double change = (force.cast<double>() - finite).norm();
  if (change > 0) ++account_.altered;
  account_.largest_change = std::max(account_.largest_change, change);
  return force;
}

void PassivityController::settle(const Sent& sent, const Eigen::Vector3d& step) noexcept {
  const double given = sent.work - std::exchange(work_, sent.work);
  account_.balance -= given;
  const double dissipated = std::min(settings_.friction * step.norm(), std::max(0.0, -account_.balance));
  account_.balance += dissipated;
  account_.dissipated += dissipated;
  account_.lowest_balance = std::min(account_.lowest_balance, account_.balance);
  account_.given += std::max(given, 0.0);
  account_.withheld += acting_wanted_.dot(step) - given;
  account_.longest_step = std::max(account_.longest_step, step.norm());
  if (kind_ != Passivity::observer && left() < 0) {
    const double forgiven = settings_.epsilon / 2 - left();
    account_.balance += forgiven;
    account_.forgiven += forgiven;
  }
  constexpr double kSmoothing = 0.005;  // s: shorter than any motion that a hand means, longer than the noise of its counts
  const double share = settings_.period / (settings_.period + kSmoothing);
  left_ += share * (left() - left_);
  step_ += share * (step - step_);
  motion_ += share * (step_ - motion_);
  way_ += step_;
  if (const double length = way_.norm(); length > settings_.longest_step) way_ *= settings_.longest_step / length;
}

// Continuous in all that it goes by, so that smooth motions under smooth laws have smooth forces.
Eigen::Vector3d PassivityController::shaped(const Eigen::Vector3d& desired) const noexcept {
  const double s = settings_.longest_step;
  Eigen::Vector3d force = desired;
  // Well within what a device may send, which then has nothing to shorten.
  const double most = std::max(left_, 0.0) / ((settings_.latency ? 2 : 1.25) * s), length = force.norm();
  if (length > most) force *= most / length;

  // While the hand goes as it went, a part of epsilon is spent and no more, over a way of `reach`. The rest is for a hand that
  // turns, and lets it have force again once it pushes: from an empty account it could put nothing in.
  const bool damps = kind_ == Passivity::damping;
  const double reach = (settings_.latency ? s : s / 2) + 2 * motion_.norm();
  const double limit = (left_ - settings_.epsilon / (damps ? 2 : 4)) / reach;
  const Eigen::Vector3d way = way_ / s;
  const double along = force.dot(way);
  if (along <= 0 || along <= limit) return force;
  // A hand at rest keeps a tenth of the force along the way that it came.
  constexpr double kSlow = 20, kAtRest = 0.9;  // mm/s
  const double moves = motion_.squaredNorm(), slow = kSlow * settings_.period, moving = moves / (moves + slow * slow);
  // At most as much as turns that part round: what was given in advance is taken back, with no larger force.
  if (damps) return force - std::min(1 - limit / along, kAtRest + (2 - kAtRest) * moving) * along * way;
  constexpr double kAlong = 0.25;  // the cosine from which on a force goes along the way
  const double part = (kAtRest + (1 - kAtRest) * moving) * std::min(1.0, along / (kAlong * force.norm()));
  return force * (1 - part * (1 - std::max(limit, 0.0) / along));
}

}  // namespace forceshade::device
