// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer that is a process and speaks lines of JSON (docs/conformance-protocol.md).

#include <cstddef>
#include <string>
#include <vector>

#include "files/child_process.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

// command: a line for /bin/sh.
OpenRenderer process_door(const std::string& command, const files::ProcessLimits& limits = {});

// The answers to so many positions in a line that a renderer wrote. Throws files::ProcessFailed.
std::vector<Eigen::Vector3f> answers_in(const std::string& said, std::size_t count);

// A renderer that is a shared object with the one function of include/forceshade.h. It is loaded in a process of its own, so
// that it has the limits of a renderer that is a process, and each of its faults is a verdict.

// The program of that process (apps/render_object.cpp), which is called with the file; its place beside the folder of this
// program.
inline constexpr const char* kObjectProgram = "libexec/forceshade/forceshade-object";

// The exit code of that process after goodbye and close(): none that an object gives that ends it itself.
inline constexpr int kObjectEndedWell = 83;

// Throws Error where that program is not there.
OpenRenderer object_door(const std::string& file, const files::ProcessLimits& limits = {});

}  // namespace forceshade::conformance
