// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force at rest, each component rounded once to binary32.

#include "reference/meshes/schemes/scheme.h"

namespace forceshade::reference::meshes {

// K D; stiffness in N/mm, the force in N.
std::array<float, 3> unshaded_force(const Rest& rest, float stiffness);

// K |D| N/|N|; K D where there is no direction, or N·D <= 0.
std::array<float, 3> shaded_force(const Direction& seen_from_front, const Rest& rest, float stiffness);

}  // namespace forceshade::reference::meshes
