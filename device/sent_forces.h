// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The account that a device keeps where its frames are, whatever the servo loop does meanwhile: the forces that it sent, and
// the work that they did. docs/safety.md, "Passivity", proves from it what a hand can be given.

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
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

// The part of an ordered force that a device's frames send. It falls at once, with the age of the order or for whatever reason
// less acts, and grows back as slowly as after a gentle start: a force that came back at once would throw the hand.

class SentShare {
 public:
  // timeout: after which an order has no force. rate: of the frames, in Hz.
  SentShare(std::chrono::nanoseconds timeout, double rate) noexcept;

  // Once a frame: the part, 0 to 1, of the force of an order that is `age` ns old. By age an order has all of its force for an
  // eighth of the timeout, and none at its end.
  double next(std::int64_t age) noexcept;

  // Then: the force that acts from this frame on, in N. An order of no force ends a fade.
  void acts(const Eigen::Vector3d& ordered, const Eigen::Vector3d& acting) noexcept;

  // The number of fades, and the frames with a part of the ordered force.
  int fades() const noexcept { return fades_; }
  double seconds() const noexcept { return frames_ * period_; }

 private:
  double timeout_, period_;  // ns; s
  double share_ = 1;
  bool fades_now_ = false;
  int fades_ = 0;
  double frames_ = 0;
};

// The forces, with the fades.
inline Sent report_of(const SentForces& forces, const SentShare& share) noexcept {
  Sent sent = forces.report();
  sent.fades = share.fades();
  sent.faded = share.seconds();
  return sent;
}

}  // namespace forceshade::device
