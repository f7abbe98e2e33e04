// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object of a rendering whose mesh is any set of triangles (docs/soups.md).

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

}  // namespace forceshade::reference::soups
