// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that a session's commands follow from what it recorded.

#include <filesystem>

namespace forceshade::apps {

// Computes a session folder again, run by run: every force of a renderer from the recorded positions by the exact
// definition, and every command from that force by supervisor and passivity controller with the recorded settings. Prints what
// differs and the counts; the exit code. A run that was cut off is computed as far as it goes. Throws Error for what is no
// session folder, or whose bumps are not those that were rendered.
int recompute_session(const std::filesystem::path& folder);

// Checks that every part of the session is whole: 0, or 1 with words about what is not.
int verify_session(const std::filesystem::path& folder);

}  // namespace forceshade::apps
