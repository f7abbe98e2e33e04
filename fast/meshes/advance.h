// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of a god-object, by the mesh's own numbering.

#include <array>
#include <optional>

#include "fast/domain.h"
#include "fast/meshes/contact/all.h"
#include "fast/meshes/force.h"

namespace forceshade::fast {

// A tick's force. Where the last stage could not decide it, the tick is invalid, as laws answer then; the state is right.
FORCESHADE_INLINE void set_force(const std::optional<std::array<float, 3>>& force, mesh::Tick& tick) noexcept {
  tick.force = force.value_or(std::array<float, 3>{});
  if (!force) [[unlikely]]
    tick.status = Status::invalid;
}

// The part of a tick that follows from where it arrived.
template <class Stages>
FORCESHADE_INLINE void settle(const Mesh& mesh, const Arrival& at, const HandAndGoal& ends, float stiffness,
                              mesh::Shading shading, const Stages& stages, mesh::Tick& tick) noexcept {
  tick.moves = static_cast<std::uint16_t>(at.moves);
  tick.status = !at.is_finished                            ? Status::unfinished
                : at.grid_point.place == mesh::Place::free ? Status::free
                                                           : Status::contact;
  if (mesh.has_stiffness() && is_touching(at.grid_point)) stiffness = stiffness_at(mesh, at.grid_point, stiffness);
  if (mesh.has_damping() && is_touching(at.grid_point)) tick.damping = damping_at(mesh, at.grid_point);
  ForceDecision decided;
  set_force(mesh_force(mesh, at, ends, stiffness, shading, Stages::kFilter, &decided), tick);
  if (decided.last != Stage::binary64) stages.note(decided.last);
}

// Kept out of line, so that a tick of the usual rule is as fast as if there were no other.
template <class Stages>
[[gnu::noinline]] void advance_by(mesh::Contact contact, const Mesh& mesh, Arrival& at, const std::array<float, 3>& p,
                                  float stiffness, mesh::Shading shading, const Stages& stages, mesh::Tick& tick) noexcept {
  const Goal goal = move_by(contact, mesh, at, p, stages, ContactRules::Others());
  if (!goal.is_decided) return set_force(std::nullopt, tick);
  settle(mesh, at, HandAndGoal(p, goal), stiffness, shading, stages, tick);
}

// Moves it to where one position of its path leads it: 256 moves at most. p: mm, in the domain and quantised; stiffness: N/mm.
// The mesh has what the shading and the contact rule use. `tick` gets all but the state.
template <class Stages>
FORCESHADE_INLINE void advance(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, float stiffness,
                               mesh::Shading shading, const Stages& stages, mesh::Tick& tick,
                               mesh::Contact contact = mesh::kUsualContact) noexcept {
  if (contact != mesh::kUsualContact) [[unlikely]]
    return advance_by(contact, mesh, at, p, stiffness, shading, stages, tick);
  ContactRules::Usual::move(mesh, at, p, stages);
  settle(mesh, at, HandAndGoal(p), stiffness, shading, stages, tick);
}

}  // namespace forceshade::fast
