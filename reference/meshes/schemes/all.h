// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the shading schemes of this side.

#include <memory>
#include <variant>

#include "reference/meshes/schemes/scheme.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::reference::meshes {

// That of a rendering in which first_error() finds nothing; null where its force is not shaded. surface: of its mesh, which has
// to outlive the scheme. Refused with the reason: a texture's height map that HeightMapField refuses.
std::variant<std::unique_ptr<const Scheme>, ParameterError> scheme_of(const MeshRendering& rendering, const Surface& surface);

}  // namespace forceshade::reference::meshes
