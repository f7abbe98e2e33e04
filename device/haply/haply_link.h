// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An Inverse3 in a session of the Inverse Service: a frame is a message with a force, and the state that answers it.

#include <chrono>
#include <memory>
#include <string>

#include "device/frames/link.h"
#include "device/haply/conversation.h"
#include "device/haply/haply_messages.h"

namespace forceshade::device::haply {

class Link final : public FrameLink {
 public:
  // id: of the arm. The session has begun.
  Link(std::unique_ptr<Conversation> service, const Version& version, const std::string& id, const FramedOptions& options)
      : service_(std::move(service)),
        id_(id),
        messages_(version, id),
        answer_(options.answer),
        end_(options.end),
        may_force_(options.force) {}

  FrameState exchange(const Eigen::Vector3d& force) override;
  void close() noexcept override;
  std::string remark() const override;

 private:
  std::unique_ptr<Conversation> service_;
  std::string id_;
  Frames messages_;
  std::chrono::milliseconds answer_, end_;  // it may take so long
  bool may_force_, is_closed_ = false;
};

}  // namespace forceshade::device::haply
