// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session of any renderer with damping behind it, which whatever drives sessions drives (docs/damping.md).
//
//   const auto damping = std::get<fast::Damping>(fast::Damping::build({.rate = 1000, .damping = 0.002F}));
//   const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
//   const std::unique_ptr<fast::Session> session = fast::damped(fast::session_of(law), damping);
//   session->step({0, 0, 0});
//   const Eigen::Vector3f force = session->step({0, 0, -0.1F}).force;  // at 100 mm/s: 0.1 N, twice the spring's
//
// Positions are in mm and forces in N. Each step is a period, unless step_after() says how many it is. damp() does the same
// behind a batch of forces.
//
// Not promised: that a servo loop's late ticks count as the periods that passed; ServoOptions::damping of servo_loop.h does it.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "forceshade/fast.h"
#include "forceshade/session.h"

namespace forceshade::fast {

class DampedSession final : public Session {
 public:
  // session: not null. damping: with the state to begin from.
  DampedSession(std::unique_ptr<Session> session, const Damping& damping) noexcept
      : session_(std::move(session)), damping_(damping) {}

  Evaluation step(const Eigen::Vector3f& position) noexcept override { return step_after(1, position); }
  // periods: as of Damping::tick().
  Evaluation step_after(std::uint32_t periods, const Eigen::Vector3f& position) noexcept {
    return damping_.tick(position, periods, session_->step(position));
  }
  void look_ahead() noexcept override { session_->look_ahead(); }
  std::uint64_t shown() const noexcept override { return session_->shown(); }

  // For its state: reset(), state() and resume().
  Damping& damping() noexcept { return damping_; }

 private:
  std::unique_ptr<Session> session_;
  Damping damping_;
};

// The session itself where damping is off, which then costs nothing.
inline std::unique_ptr<Session> damped(std::unique_ptr<Session> session, const Damping& damping) {
  if (damping.parameters().is_off()) return session;
  return std::make_unique<DampedSession>(std::move(session), damping);
}

// Damps forces[i], which a law or a height map gave at positions[i], in their place: a tick for each, one after the other; as
// many as the shorter span has. periods[i]: those since the tick before; 1 beyond the span's end. Counts the positions outside
// the domain.
inline BatchResult damp(Damping& damping, std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                        std::span<const std::uint32_t> periods = {}) noexcept {
  BatchResult result;
  for (std::size_t i = 0; i < std::min(positions.size(), forces.size()); ++i) {
    const Evaluation damped = damping.tick(positions[i], i < periods.size() ? periods[i] : 1, {forces[i], Status::contact});
    forces[i] = damped.force;
    result.invalid += damped.status == Status::invalid ? 1 : 0;
  }
  return result;
}

}  // namespace forceshade::fast
