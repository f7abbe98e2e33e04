// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The last ticks before a run was stopped by the supervisor or by a fault of the device, in words and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "device/sample.h"

namespace forceshade::apps {

inline constexpr double kKeptBeforeTheEnd = 0.2;  // s

// Of the last tick: position, speed, force, rules. Prints nothing without samples.
void print_last_ticks(const std::vector<device::Sample>& samples);

// An array, oldest first: tick, t_s, position_mm, law_force_N, force_N, limited (names of rules), tripped (its name or null).
nlohmann::ordered_json last_ticks_json(const std::vector<device::Sample>& samples);

}  // namespace forceshade::apps
