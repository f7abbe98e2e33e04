// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of an ordered force that a device's frames send. It falls at once, with the age of the order or for whatever reason
// less acts, and grows back as slowly as after a gentle start: a force that came back at once would throw the hand.

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "device/sent_forces.h"

namespace forceshade::device {

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
