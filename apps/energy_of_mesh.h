// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The energy that the shading of a mesh can give to the hand, for forceshade energy.

#include <string>

#include "forceshade/identity.h"

namespace forceshade::apps {

// depth: of the god-object from the hand; length: of a closed path; step: of the hand from tick to tick; all in mm. json: where
// the verdict goes as JSON, "-" for standard output, or empty. Throws Error where there is no bound for this rendering, and
// Interrupted; nothing is written then. Returns the exit code.
int print_energy_of_mesh(const std::string& name, const MeshRendering& rendering, float depth, float length, float step,
                         const std::string& json);

}  // namespace forceshade::apps
