// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Many paths over one subject, a tick of each.

#include <cstddef>

#include "bindings/c/batch.h"
#include "bindings/c/described.h"
#include "bindings/c/forces.h"
#include "bindings/c/parts.h"
#include "bindings/c/states.h"

namespace forceshade::c {

// Position i is the next one of the path whose state is state_of(i), a reference, which then is what the tick left. Returns how
// many positions were invalid. A law or a height map leaves the states as they are.
template <class StateOf>
std::size_t advance(const Subject& subject, const forceshade_batch& batch, const StateOf& state_of) noexcept {
  const auto* const god_object = std::get_if<fast::GodObject>(&subject.field);
  if (god_object == nullptr) return forces_of(subject, batch);
  return in_parts(batch, [&](const forceshade_batch& part, std::size_t begin) noexcept {
    return for_each_block(part, [&](auto positions, auto forces, auto statuses) noexcept {
      std::size_t invalid = 0;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        auto& state = state_of(begin + i);
        const Eigen::Vector3f& p = positions[i];
        const mesh::Tick tick = god_object->tick(god_object_of(state), {p.x(), p.y(), p.z()});
        put(tick.after, state);
        const fast::Evaluation answer = fast::evaluation_of(tick, fast::Stage::binary64);
        forces[i] = answer.force;
        invalid += answer.status == Status::invalid ? 1 : 0;
        if (!statuses.empty()) statuses[i] = status_of(answer);
      }
      begin += positions.size();
      return invalid;
    });
  });
}

}  // namespace forceshade::c
