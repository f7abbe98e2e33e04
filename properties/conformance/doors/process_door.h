// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer that is a process and speaks lines of JSON (docs/conformance-protocol.md).

#include <cstddef>
#include <string>
#include <vector>

#include "files/child_process.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

// command: a line for /bin/sh. allocations_line: what it is told to say what it allocated (object_door.h); empty where it does
// not count that.
OpenRenderer process_door(const std::string& command, const files::ProcessLimits& limits = {},
                          const std::string& allocations_line = "");

// The answers to so many positions in a line that a renderer wrote. Throws files::ProcessFailed.
std::vector<Eigen::Vector3f> answers_in(const std::string& said, std::size_t count);

}  // namespace forceshade::conformance
