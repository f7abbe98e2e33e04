// SPDX-License-Identifier: BSD-3-Clause
#include "device/sent_forces.h"

#include <algorithm>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

void SentForces::arrived(const Eigen::Vector3d& position) noexcept {
  acted_ = acting_;
  acting_.setZero();
  const bool seen = position.allFinite() && last_position_;
  work_ += seen ? acted_.dot(position - *last_position_) : acted_.norm() * allowance_.longest_step;
  if (position.allFinite())
    last_position_ = position;
  else
    last_position_.reset();
}

// Shortened so that it brings the work, in mJ, to no more than is allowed within a step.
Eigen::Vector3d SentForces::within(const Eigen::Vector3d& force, double work) const noexcept {
  // Room for rounding: of a device that sends in binary32, and of the sums.
  constexpr double kRoom = 0x1p-20;
  const double reach = force.norm() * allowance_.longest_step * (1 + kRoom), left = std::max(0.0, allowance_.work - work);
  return reach > left ? Eigen::Vector3d(force * (left / reach)) : force;
}

Eigen::Vector3d SentForces::send(const Eigen::Vector3d& force) noexcept {
  acting_ = within(force, work_);
  return acting_;
}

Eigen::Vector3d SentForces::send_ahead(const Eigen::Vector3d& force) const noexcept {
  return within(force, work_ + acting_.norm() * allowance_.longest_step);
}

SentShare::SentShare(std::chrono::nanoseconds timeout, double rate) noexcept
    : timeout_(static_cast<double>(timeout.count())), period_(1 / rate) {}

double SentShare::next(std::int64_t age) noexcept {
  const double held = timeout_ / 8, left = std::clamp((timeout_ - static_cast<double>(age)) / (timeout_ - held), 0.0, 1.0);
  share_ = std::min(left, share_ + period_ / SupervisorLimits{}.ramp_up);
  return share_;
}

void SentShare::acts(const Eigen::Vector3d& ordered, const Eigen::Vector3d& acting) noexcept {
  constexpr double kRoom = 1e-9;  // for rounding
  const double whole = ordered.norm(), size = acting.norm();
  if (whole == 0)
    share_ = 1;
  else if (size < share_ * whole * (1 - kRoom))
    share_ = size / whole;
  // A force that is switched off is no fade; it is one while it comes back.
  const bool fades = share_ < 1 && (fades_now_ || size > 0);
  if (fades && !fades_now_) ++fades_;
  if (fades) ++frames_;
  fades_now_ = fades;
}

}  // namespace forceshade::device
