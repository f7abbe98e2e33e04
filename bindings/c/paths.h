// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Many paths over one subject, a tick of each.

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "bindings/c/batch.h"
#include "bindings/c/described.h"
#include "bindings/c/forces.h"
#include "bindings/c/parts.h"
#include "bindings/c/states.h"

namespace forceshade::c {

// Position i is the next one of the path whose state is state_of(i), a reference, which then is what the tick left. Returns how
// many positions were invalid. A law or a height map leaves the states as they are. On a mesh that is not regular it allocates
// a session for each thread, and may throw.
template <class StateOf>
std::size_t advance(const Subject& subject, const forceshade_batch& batch, const StateOf& state_of) {
  const auto* const god_object = std::get_if<fast::GodObject>(&subject.field);
  if (god_object == nullptr) return forces_of(subject, batch);
  const auto in_ticks = [&](const auto& tick_of_part) {
    return in_parts(batch, [&](const forceshade_batch& part, std::size_t begin) noexcept {
      const auto tick_from = tick_of_part();
      return answer_each(part, [&](const Eigen::Vector3f& p, std::size_t index) noexcept {
        auto& state = state_of(begin + index);
        const mesh::Tick tick = tick_from(god_object_of(state), {p.x(), p.y(), p.z()});
        put(tick.after, state);
        return fast::evaluation_of(tick, fast::Stage::binary64);
      });
    });
  };
  using Position = std::array<float, 3>;
  if (subject.is_regular)
    return in_ticks(
        [&] { return [&](const mesh::GodObject& state, const Position& p) noexcept { return god_object->tick(state, p); }; });
  std::vector<std::unique_ptr<fast::TickSession>> sessions(parts_of(batch));
  for (auto& session : sessions) session = god_object->open();
  std::atomic<std::size_t> next = 0;
  return in_ticks([&] {
    fast::TickSession& session = *sessions[next++];
    return [&session](const mesh::GodObject& state, const Position& p) noexcept {
      session.resume(state);
      return session.tick(p);
    };
  });
}

}  // namespace forceshade::c
