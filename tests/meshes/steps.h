// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick on the fast path from any state, compiled once for all tests, because it takes ten seconds.

#include "fast/meshes/advance.h"

namespace forceshade::fast {

// Counts the decisions of each stage.
struct CountedStages {
  static constexpr bool kFilter = true;
  std::size_t* in_binary64;
  std::size_t* in_integers;
  bool sure(bool is_proved) const noexcept {
    *in_binary64 += is_proved;
    return is_proved;
  }
  void note(Stage) const noexcept { ++*in_integers; }
};

// advance(), by a contact rule that the mesh has.
template <class Stages>
void arrive(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, float stiffness, mesh::Shading shading,
            const Stages& stages, mesh::Tick& tick, mesh::Contact contact = mesh::kUsualContact) noexcept {
  advance(mesh, at, p, stiffness, shading, stages, tick, contact);
}

// Moves a god-object by one position. position: mm; stiffness: N/mm. A state that is not one of this mesh counts as none.
template <class Stages = FilteredStages>
mesh::Tick step(const Mesh& mesh, const mesh::GodObject& before, const std::array<float, 3>& position, float stiffness,
                mesh::Shading shading, const Stages& stages = {}, mesh::Contact contact = mesh::kUsualContact) noexcept {
  const mesh::Contact its = contact_in(mesh, contact);
  Arrival at = arrival_of(mesh, before, its);
  mesh::Tick tick;
  if (in_domain(position)) advance(mesh, at, quantised(position), stiffness, shading, stages, tick, its);
  tick.after = object_of(mesh, at);
  return tick;
}

extern template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                                const FilteredStages&, mesh::Contact) noexcept;
extern template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                                const ExactStages&, mesh::Contact) noexcept;

extern template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const CountedStages&,
                            mesh::Tick&, mesh::Contact) noexcept;
extern template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const FilteredStages&,
                            mesh::Tick&, mesh::Contact) noexcept;

}  // namespace forceshade::fast
