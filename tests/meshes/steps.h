// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick on the fast path, compiled once for all tests, because it takes ten seconds.

#include "forceshade/fast/meshes/god_object.h"

namespace forceshade::fast {

extern template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                                const FilteredStages&) noexcept;
extern template mesh::Tick step(const Mesh&, const mesh::GodObject&, const std::array<float, 3>&, float, mesh::Shading,
                                const ExactStages&) noexcept;

}  // namespace forceshade::fast
