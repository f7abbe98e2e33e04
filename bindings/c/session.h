// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session whose state goes out and in.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <variant>

#include "bindings/c/described.h"
#include "forceshade/fast.h"
#include "forceshade/mesh.h"

namespace forceshade::c {

// For one thread at a time.
class Session {
 public:
  static constexpr const char* kBusy = "another thread is in this session, which is for one at a time";
  static constexpr const char* kNone = "invalid session handle: it was never opened, or has been closed";
  static constexpr const char* kTooMany = "there are too many sessions; expected some to be closed";

  explicit Session(const Subject& subject)
      : session_(subject.renderer.open()),
        ticks_(dynamic_cast<fast::TickSession*>(session_.get())),
        is_regular_(subject.is_regular) {
    if (const auto* law = std::get_if<fast::Law>(&subject.field)) law_ = *law;
  }

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept {
    if (law_) return law_->evaluate(position);  // which is what its session does, in two calls
    if (ticks_ == nullptr) return session_->step(position);
    const mesh::Tick tick = ticks_->tick({position.x(), position.y(), position.z()});
    state_ = tick.after;
    return fast::evaluation_of(tick, ticks_->stage());
  }

  bool remembers() const noexcept { return ticks_ != nullptr; }
  // False where a state also has the name of a cell.
  bool is_regular() const noexcept { return is_regular_; }
  const mesh::GodObject& state() const noexcept { return state_; }
  // A state that is not one of this subject counts as that of a beginning, which state() then is.
  void resume(const mesh::GodObject& state) noexcept {
    if (ticks_ == nullptr) return;
    ticks_->resume(state);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    state_ = ticks_->tick({kNan, kNan, kNan}).after;  // an invalid position changes nothing
  }

 private:
  std::optional<fast::Law> law_;
  std::unique_ptr<fast::Session> session_;
  fast::TickSession* ticks_;  // the same, where it is a god-object's
  bool is_regular_;
  mesh::GodObject state_;
};

}  // namespace forceshade::c
