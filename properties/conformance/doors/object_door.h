// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer that is a shared object with the one function of include/forceshade.h. It is loaded in a process of its own, so
// that it has the limits of a renderer that is a process, and each of its faults is a verdict.

#include <string>
#include <string_view>

#include "files/child_process.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

// The program of that process (apps/render_object.cpp), which is called with the file; its place beside the folder of this
// program.
inline constexpr const char* kObjectProgram = "libexec/forceshade/forceshade-object";

// That process is told this line to say how often and how much the object allocated in its answers so far:
// {"calls":2,"bytes":96}, or {} where it does not know.
inline constexpr std::string_view kAllocations = R"({"allocations":true})";
// The exit code of that process after goodbye and close(): none that an object gives that ends it itself.
inline constexpr int kObjectEndedWell = 83;

// Throws Error where that program is not there.
OpenRenderer object_door(const std::string& file, const files::ProcessLimits& limits = {});

}  // namespace forceshade::conformance
