// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What identifies a god-object on a mesh.

#include <string>

#include "forceshade/identity/identity.h"
#include "forceshade/vocabulary/mesh.h"

namespace forceshade::properties {

inline constexpr const char kMeshKind[] = "mesh";

// What a god-object is built from. normals: of each corner of each triangle; none where nothing is shaded.
struct MeshRendering {
  mesh::TriangleMesh mesh;
  mesh::CornerNormals normals;
  mesh::Sides sides = mesh::Sides::front;
  mesh::Shading shading = mesh::Shading::none;
  float stiffness = 0;         // K, N/mm, in [10^-3, 10^3]
  mesh::Texture texture = {};  // of the texture scheme
  mesh::SelfIntersections self_intersections = mesh::SelfIntersections::refused;
};

// name: of the mesh's file. The digest is that of every coordinate, index and normal, and of a texture: of the points and
// gradients of its corners and of its height map.
Identity identity_of(const std::string& name, const MeshRendering& rendering);

}  // namespace forceshade::properties
