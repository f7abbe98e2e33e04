// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulator that is a process and speaks lines of JSON (docs/conformance-protocol.md, "Simulators").

#include <string>

#include "properties/conformance/doors/child_process.h"
#include "properties/conformance/simulators/simulator_under_test.h"

namespace forceshade::conformance::simulators {

OpenSimulator simulator_process(const std::string& command, const ProcessLimits& limits = {});

}  // namespace forceshade::conformance::simulators
