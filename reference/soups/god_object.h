// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object of a rendering whose mesh is any set of triangles (docs/soups.md).

#include <array>
#include <memory>

#include "reference/meshes/rounding.h"
#include "reference/meshes/ticks.h"
#include "reference/soups/tick.h"

namespace forceshade {
struct MeshRendering;
}  // namespace forceshade

namespace forceshade::reference::soups {

// The states of one soup as numbers of constant size.
State state_of(const mesh::GodObject& object);
mesh::GodObject object_of(const State& state);

std::unique_ptr<const meshes::Ticks> ticks_of(const MeshRendering& rendering);

// The force at rest, exactly: K D; with corner normals, one for each corner of each triangle of the file, K (|D_n| N/|N| +
// D_t). stiffness: K, N/mm.
std::array<meshes::RootSum, 3> exact_force(const Rest& rest, float stiffness, const mesh::CornerNormals& normals = {});

}  // namespace forceshade::reference::soups
