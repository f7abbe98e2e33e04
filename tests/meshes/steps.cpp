// SPDX-License-Identifier: BSD-3-Clause
#include "tests/meshes/steps.h"

namespace forceshade::fast {

template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const FilteredStages&, mesh::Contact) noexcept;
template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const ExactStages&, mesh::Contact) noexcept;

template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const CountedStages&,
                     mesh::Tick&, mesh::Contact) noexcept;
template void arrive(const Mesh&, Arrival&, const std::array<float, 3>&, float, mesh::Shading, const FilteredStages&,
                     mesh::Tick&, mesh::Contact) noexcept;

}  // namespace forceshade::fast
