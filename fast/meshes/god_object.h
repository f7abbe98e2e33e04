// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object on a mesh in real time: state, moves and force equal the exact definition in every bit (docs/meshes.md).

#include <array>

#include "forceshade/fast/domain.h"
#include "forceshade/fast/meshes/force.h"

namespace forceshade::fast {

// Moves a god-object, by the mesh's own numbering, to where one position of its path leads it. `tick` gets all but the state.
// An invalid position leaves it as it was.
template <class Stages>
FORCESHADE_INLINE void step(const Mesh& mesh, Arrival& at, const std::array<float, 3>& position, float stiffness,
                            mesh::Shading shading, const Stages& stages, mesh::Tick& tick) noexcept {
  tick.force = {};
  tick.moves = 0;
  tick.status = mesh::TickStatus::invalid;
  if (!in_domain(position)) return;
  const std::array<float, 3> p = quantised(position);
  if (mesh.has_sheets()) [[unlikely]]
    Walk<Stages, true>(mesh, at, p, stages).run();
  else
    Walk<Stages>(mesh, at, p, stages).run();
  tick.moves = static_cast<std::uint16_t>(at.moves);
  tick.status = !at.is_finished                      ? mesh::TickStatus::unfinished
                : at.spot.place == mesh::Place::free ? mesh::TickStatus::free
                                                     : mesh::TickStatus::touching;
  ForceDecision decided;
  tick.force = mesh_force(mesh, at, p, stiffness, shading, Stages::kFilter, &decided);
  if (decided.last != Stage::binary64) stages.note(decided.last);
}

// What one position does to a god-object. Without allocation, lock or exception; a tick makes 256 moves at most. position: mm;
// stiffness: N/mm. A state that is not one of this mesh counts as none.
template <class Stages = FilteredStages>
mesh::Tick step(const Mesh& mesh, const mesh::GodObject& before, const std::array<float, 3>& position, float stiffness,
                mesh::Shading shading, const Stages& stages = {}) noexcept {
  Arrival at{spot_of(mesh, before), Rest::none, 0, true};
  mesh::Tick tick;
  step(mesh, at, position, stiffness, shading, stages, tick);
  tick.after = object_of(mesh, at.spot);
  return tick;
}

}  // namespace forceshade::fast
