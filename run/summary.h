// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The summary of a run for programs. summary.md beside it lists its fields.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "forceshade/identity.h"
#include "forceshade/run.h"
#include "forceshade/servo_loop.h"

namespace forceshade::run {

// For programs: what was rendered, where, and what came of it. signal: the one that ended the run; empty is
// none.
nlohmann::ordered_json summary(const Outcome& outcome, const Rendering& what, const Plan& plan,
                               const device::Capabilities& capabilities, const std::string& signal = "");

// The rendering: its kind, name, digest and parameters.
nlohmann::ordered_json summary_of(const Identity& identity);

// The servo loop's measurements.
nlohmann::ordered_json to_json(const device::ServoResult& run);

// The damping of a run that had some, and what it gave; an infinite `most` is null.
nlohmann::ordered_json damping_json(const device::ServoResult& run);

// The pacer of the ticks, "device" or "clock"; null where ticks followed one another.
const char* pacer_of(const device::ServoResult& run);

// An array, oldest first: tick, t_s, position_mm, law_force_N, force_N, limited (names of rules), tripped (its name or null).
nlohmann::ordered_json last_ticks_json(const std::vector<device::Sample>& samples);

}  // namespace forceshade::run
