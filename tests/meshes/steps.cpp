// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/tests/meshes/steps.h"

namespace forceshade::fast {

template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const FilteredStages&) noexcept;
template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                         const ExactStages&) noexcept;

}  // namespace forceshade::fast
