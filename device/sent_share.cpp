// SPDX-License-Identifier: BSD-3-Clause
#include "device/sent_share.h"

#include <algorithm>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

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
