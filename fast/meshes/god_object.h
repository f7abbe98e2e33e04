// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object on a mesh in real time: state, moves and force equal the exact definition in every bit (docs/meshes.md).

#include <array>

#include "forceshade/fast/domain.h"
#include "forceshade/fast/meshes/force.h"

namespace forceshade::fast {

// One position of a god-object's path, by the mesh's own numbering.
struct MeshTick {
  Arrival arrival;
  mesh::TickStatus status = mesh::TickStatus::invalid;
  std::array<float, 3> force{};  // N
};

template <class Stages = FilteredStages>
MeshTick step(const Mesh& mesh, const Spot& before, const std::array<float, 3>& position, float stiffness,
              mesh::Shading shading, const Stages& stages = {}) noexcept {
  if (!in_domain(position[0]) || !in_domain(position[1]) || !in_domain(position[2]))
    return {{before}, mesh::TickStatus::invalid, {}};
  const std::array<float, 3> p{quantised(position[0]), quantised(position[1]), quantised(position[2])};
  MeshTick tick;
  tick.arrival = Walk<Stages>(mesh, p, stages).run(before);
  tick.status = !tick.arrival.is_finished                      ? mesh::TickStatus::unfinished
                : tick.arrival.spot.place == mesh::Place::free ? mesh::TickStatus::free
                                                               : mesh::TickStatus::touching;
  tick.force = mesh_force(mesh, tick.arrival, p, stiffness, shading, Stages::kFilter);
  return tick;
}

// What one position does to a god-object. Without allocation, lock or exception; a tick makes 256 moves at most. position: mm;
// stiffness: N/mm. A state that is not one of this mesh counts as none.
template <class Stages = FilteredStages>
mesh::Tick step(const Mesh& mesh, const mesh::GodObject& before, const std::array<float, 3>& position, float stiffness,
                mesh::Shading shading, const Stages& stages = {}) noexcept {
  const MeshTick tick = step(mesh, spot_of(mesh, before), position, stiffness, shading, stages);
  return {tick.status, tick.arrival.moves, tick.force, object_of(mesh, tick.arrival.spot)};
}

}  // namespace forceshade::fast
