// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Places a mesh in a scene: computed exactly and rounded once (docs/scenes.md, "Definition").

#include <vector>

#include "forceshade/mesh.h"
#include "forceshade/scene.h"

namespace forceshade::mesh {

inline constexpr float kLeastOfRotation = 0x1p-30F, kMostOfRotation = 2;  // in size, of a component that is not 0

// True if it is a component of a rotation, or of a translation.
bool is_of_rotation(float component);
bool is_of_translation(float component);

// R a + t of each vertex a that a file can have: each coordinate is the binary32 number nearest to the exact one, ties to
// even, and +0 where that is below 2^-30 mm in size. A coordinate may come out beyond 10^4 mm, which check() refuses.
std::vector<Vertex> placed(std::vector<Vertex> vertices, const scene::Pose& placement);

}  // namespace forceshade::mesh
