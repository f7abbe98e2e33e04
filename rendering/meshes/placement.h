// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a mesh lies in a scene: a rotation and a translation, computed exactly and rounded once (docs/scenes.md, "Placement").

#include <array>
#include <vector>

#include "forceshade/mesh.h"

namespace forceshade::mesh {

// A quaternion's components are in the order w, x, y, z. It may have any length but 0: R = A/(w^2 + x^2 + y^2 + z^2) with
// A11 = w^2 + x^2 - y^2 - z^2, A12 = 2(xy - wz), ... is an exact rotation.
struct Placement {
  std::array<float, 3> translation{};         // mm, each within 10^4; one below 2^-30 in size is read as 0
  std::array<float, 4> rotation{1, 0, 0, 0};  // each 0, or of 2^-30 to 2 in size; not all 0
};

inline constexpr float kLeastOfRotation = 0x1p-30F, kMostOfRotation = 2;  // in size, of a component that is not 0

// Whether it is a component of a rotation, and of a translation.
bool is_of_rotation(float component);
bool is_of_translation(float component);

// R a + t of each vertex a that a file can have: each coordinate is the binary32 number nearest to the exact one, ties to
// even, and +0 where that is below 2^-30 mm in size. A coordinate may come out beyond 10^4 mm, which check() refuses.
std::vector<Vertex> placed(std::vector<Vertex> vertices, const Placement& placement);

}  // namespace forceshade::mesh
