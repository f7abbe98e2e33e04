// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion of an object from a CSV file of poses (docs/scenes.md, "Motions in the file").

#include <string>

#include "forceshade/scene.h"

namespace forceshade::subjects {

inline constexpr double kLeastRate = 100, kMostRate = 10000;  // ticks per second
inline constexpr std::size_t kMostPoses = 4000000;            // of a motion

// rate: ticks per second. repeats: as scene::Motion has it. Throws Error with file, line and column.
scene::Motion read_motion(const std::string& file, double rate, bool repeats);

}  // namespace forceshade::subjects
