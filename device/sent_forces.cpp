// SPDX-License-Identifier: BSD-3-Clause
#include "device/sent_forces.h"

#include <algorithm>

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

}  // namespace forceshade::device
