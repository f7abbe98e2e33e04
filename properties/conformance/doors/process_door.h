// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer that is a process and speaks lines of JSON (docs/conformance-protocol.md).

#include <string>

#include "properties/conformance/doors/child_process.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

// command: a line for /bin/sh.
OpenRenderer process_door(const std::string& command, const ProcessLimits& limits = {});

}  // namespace forceshade::conformance
