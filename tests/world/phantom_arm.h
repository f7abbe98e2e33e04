// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Faults of a PHANToM in the simulated world: with the vendor's driver, and with the process that has it.

#include <chrono>
#include <vector>

#include "tests/world/arms.h"
#include "tests/world/hd.h"

namespace forceshade::world {

// Options that wait for no call of the driver for long.
inline const OpenPhantom kImpatient{.options = {.open = std::chrono::milliseconds(500),
                                                .start = std::chrono::milliseconds(800),
                                                .calibration = std::chrono::milliseconds(500)}};

Fault endless_frame();  // one of the next
std::vector<Fault> blocking_calls();
std::vector<Fault> errors_of_the_driver();
// Crashes whichever of its threads makes the step.
Fault crash_of_the_driver();
Fault stop_of_the_driver();
// It is killed, or its own thread goes no further: nothing on the machine can end its force.
std::vector<Fault> losses_of_the_driver();

// As arms() have them, but its watchdog is a process, and some of its faults are for the device alone to end.
ArmKind phantom_arm();

}  // namespace forceshade::world
