// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulator that is a process and speaks lines of JSON (docs/conformance-protocol.md, "Simulators").

#include <cstddef>
#include <string>

#include "files/child_process.h"
#include "properties/conformance/simulators/simulator_under_test.h"

namespace forceshade::conformance::simulators {

OpenSimulator simulator_process(const std::string& command, const files::ProcessLimits& limits = {});

// Reads a simulator's lines: about itself, and in answer to so many forces. Both throw files::ProcessFailed.
SimulatorCapabilities capabilities_of(const nlohmann::ordered_json& hello);
Motion motion_in(const nlohmann::ordered_json& said, SimulatorCapabilities::Reports reports, const Simulation& scene,
                 std::size_t count);

}  // namespace forceshade::conformance::simulators
