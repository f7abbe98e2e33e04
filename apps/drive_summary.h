// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The summary of a run for people, on standard output.

#include <vector>

#include "forceshade/servo_loop.h"

namespace forceshade::apps {

void print(const device::ServoResult& result);

// The last ticks before the supervisor or a fault of the device ended a run: of the last one position, speed, force, rules.
// Prints nothing without samples.
void print_last_ticks(const std::vector<device::Sample>& samples);

}  // namespace forceshade::apps
