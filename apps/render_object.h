// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The process of properties/conformance/doors/object_door.h.

#include <string>

namespace forceshade::apps {

// Loads the shared object and answers for it on standard input and output (docs/conformance-protocol.md) until goodbye. What
// the object itself prints goes to standard error. Returns the exit code.
int render_object(const std::string& file);

}  // namespace forceshade::apps
