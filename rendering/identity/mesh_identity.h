// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What identifies a god-object on a mesh.

#include <string>

#include "rendering/identity/identity.h"
#include "rendering/mesh_rendering.h"

namespace forceshade {

inline constexpr const char kMeshKind[] = "mesh";

// name: of the mesh's file. The digest is that of every coordinate, index and normal, and of a texture: of the points and
// gradients of its corners and of its height map.
Identity identity_of(const std::string& name, const MeshRendering& rendering);

}  // namespace forceshade
