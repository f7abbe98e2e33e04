// SPDX-License-Identifier: BSD-3-Clause
#include "tests/meshes/steps.h"

namespace forceshade::fast {

mesh::Tick walk_through_sheets(const Mesh& mesh, const mesh::GodObject& before, const std::array<float, 3>& position) noexcept {
  Arrival at{grid_point_of(mesh, before), RestKind::none, 0, true};
  mesh::Tick tick;
  if (in_domain(position)) {
    Walk<FilteredStages>(mesh, at, quantised(position), {}).run();
    tick.moves = static_cast<std::uint16_t>(at.moves);
  }
  tick.after = object_of(mesh, at.grid_point);
  return tick;
}

template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const FilteredStages&, mesh::Contact) noexcept;
template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const ExactStages&, mesh::Contact) noexcept;

template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const CountedStages&,
                     mesh::Tick&, mesh::Contact) noexcept;
template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const FilteredStages&,
                     mesh::Tick&, mesh::Contact) noexcept;

}  // namespace forceshade::fast
