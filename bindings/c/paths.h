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
    return answer_each(part, [&](const Eigen::Vector3f& p, std::size_t index) noexcept {
      auto& state = state_of(begin + index);
      const mesh::Tick tick = god_object->tick(god_object_of(state), {p.x(), p.y(), p.z()});
      put(tick.after, state);
      return fast::evaluation_of(tick, fast::Stage::binary64);
    });
  });
}

}  // namespace forceshade::c
