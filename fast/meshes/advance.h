// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick of a god-object, by the mesh's own numbering.

#include <array>
#include <optional>

#include "fast/domain.h"
#include "fast/meshes/force.h"

namespace forceshade::fast {

// A tick's force. Where the last stage could not decide it, the tick is invalid, as laws answer then; the state is right.
FORCESHADE_INLINE void set_force(const std::optional<std::array<float, 3>>& force, mesh::Tick& tick) noexcept {
  tick.force = force.value_or(std::array<float, 3>{});
  if (!force) [[unlikely]]
    tick.status = mesh::TickStatus::invalid;
}

// Moves it to where one position of its path leads it: 256 moves at most. p: mm, in the domain and quantised; stiffness: N/mm.
// `tick` gets all but the state.
template <class Stages>
FORCESHADE_INLINE void advance(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, float stiffness,
                               mesh::Shading shading, const Stages& stages, mesh::Tick& tick) noexcept {
  if (mesh.has_sheets()) [[unlikely]]
    Walk<Stages, true>(mesh, at, p, stages).run();
  else
    Walk<Stages>(mesh, at, p, stages).run();
  tick.moves = static_cast<std::uint16_t>(at.moves);
  tick.status = !at.is_finished                      ? mesh::TickStatus::unfinished
                : at.spot.place == mesh::Place::free ? mesh::TickStatus::free
                                                     : mesh::TickStatus::touching;
  ForceDecision decided;
  set_force(mesh_force(mesh, at, p, stiffness, shading, Stages::kFilter, &decided), tick);
  if (decided.last != Stage::binary64) stages.note(decided.last);
}

}  // namespace forceshade::fast
