// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force at a rest: K times the way from p to r, or as long as that along the shading direction, each component correctly
// rounded.

#include "fast/meshes/contact/goal.h"
#include "fast/meshes/walk.h"

namespace forceshade::fast {

// The numbers that decided a shaded force; unshaded ones are not distinguished.
enum class ForceStage { unshaded, binary64, from_integers, wide };

struct ForceDecision {
  ForceStage numbers = ForceStage::unshaded;
  Stage last = Stage::binary64;  // of all that the force is made of, slopes of a texture included
};

// N. stiffness: N/mm. The mesh has what the scheme uses. is_filtered: for tests;
// false leaves all to exact numbers. decided: what did, where it is not null. Empty where the last stage cannot decide.
std::optional<std::array<float, 3>> mesh_force(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends,
                                               float stiffness, mesh::Shading shading, bool is_filtered = true,
                                               ForceDecision* decided = nullptr) noexcept;

// The fault of force.cpp, as arithmetic_fault_here() of fast/numbers/arithmetic.h.
const char* force_arithmetic_fault() noexcept;

}  // namespace forceshade::fast
