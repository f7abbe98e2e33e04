// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_link.h"

#include <algorithm>

namespace forceshade::device::haply {
namespace {

constexpr std::chrono::milliseconds kToEnd{100};  // for the service to take the zero, and to end the session

// The origin of the device is the middle of its workspace, which two clients agree on; the service does not say it.
const Eigen::Vector3d kMiddle{0, -150, 200};  // mm, in the service's frame

}  // namespace

FrameState Link::exchange(const Eigen::Vector3d& force) {
  const Answer answer = service_->ask(may_force_ ? messages_.with_force(force) : messages_.without_force(), answer_);
  if (answer.kind == Answer::Kind::late)
    throw Error("the Inverse Service has not answered for " + std::to_string(answer_.count()) +
                " ms; if the device still pushes, switch it off");
  is_closed_ = answer.kind == Answer::Kind::closed;
  if (is_closed_)
    throw Error("the Inverse Service has closed the connection (" + service_->why() +
                "); if the device still pushes, switch it off");
  const Message message = message_of(answer.text);
  const auto arm = std::find_if(message.arms.begin(), message.arms.end(), [&](const Inverse3& a) { return a.id == id_; });
  if (arm == message.arms.end()) throw Error("the Inverse3 is no longer connected: check its cable and its power");
  if (!arm->altered.empty()) throw Error(arm->altered);
  if (!arm->position) throw Error("the Inverse Service sent a state without a position of the Inverse3");
  return {.position = *arm->position - kMiddle,
          .buttons = message.buttons,
          .calibrated = arm->calibrated,
          .forces_on = may_force_ && arm->powered && arm->ready,
          .forces_off = !arm->powered ? "its power supply is off"
                        : !arm->ready ? "the service reports that it is not ready"
                                      : "",
          .applied = arm->force};
}

void Link::close() noexcept {
  const std::chrono::milliseconds longest = std::max(kToEnd, end_);
  try {
    if (may_force_ && !is_closed_) service_->ask(messages_.with_force(Eigen::Vector3d::Zero()), longest);
  } catch (const std::exception&) {
  }
  service_->close(longest);
}

std::string Link::remark() const {
  return service_->unasked() > 0 ? std::to_string(service_->unasked()) + " messages came unasked" : "";
}

}  // namespace forceshade::device::haply
