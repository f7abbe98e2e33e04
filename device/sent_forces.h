// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The account that a device keeps where its frames are, whatever the servo loop does meanwhile: the forces that it sent, and
// the work that they did. docs/safety.md, "Passivity", proves from it what a hand can be given.

#include <Eigen/Core>
#include <optional>

#include "forceshade/device.h"

namespace forceshade::device {

class SentForces {
 public:
  // A frame has measured this position, in mm. Of a step whose beginning or end is not finite the worst is assumed: the longest
  // one along the force.
  void arrived(const Eigen::Vector3d& position) noexcept;

  // The frame is to send this force, in N. Returns what it may send, shortened as the allowance says; that then acts.
  Eigen::Vector3d send(const Eigen::Vector3d& force) noexcept;

  // As send(), for a frame that sends its force before its position is known: the step there is taken for the worst one, the
  // longest along the force that acts now. The force acts once acts() is called, after arrived().
  Eigen::Vector3d send_ahead(const Eigen::Vector3d& force) const noexcept;
  void acts(const Eigen::Vector3d& force) noexcept { acting_ = force; }

  void allow(const Allowance& allowance) noexcept { allowance_ = allowance; }

  // The forces as of the last arrival: `acting` is zero until send() is called.
  Sent report() const noexcept { return {acted_.cast<float>(), acting_.cast<float>(), work_}; }

 private:
  Eigen::Vector3d within(const Eigen::Vector3d& force, double work) const noexcept;

  Allowance allowance_;
  std::optional<Eigen::Vector3d> last_position_;
  Eigen::Vector3d acted_{0, 0, 0}, acting_{0, 0, 0};
  double work_ = 0;
};

}  // namespace forceshade::device
