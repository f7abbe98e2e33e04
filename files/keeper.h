// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A process between this program and a third-party program. Whatever that one starts stays among the keeper's descendants,
// also what leaves its session and takes away its environment, so that it is counted and ended with it.

#include <functional>

#include "files/lines.h"

namespace forceshade::files {

// The threads of all processes of this user, as the system's limit of processes counts them.
unsigned long threads_of_this_user();

// Called in a process that was forked for it. It writes to `reports`, once, how the program ended, as waitpid() gives it, or
// kTooMany. `become_program` is called in a process of its own and replaces it. When there are more descendants and threads of
// them than the limits say, or when the other end of `control` is closed and the program has ended or its grace is over, all of
// them are ended, and it ends itself.
[[noreturn]] void keep(const std::function<void()>& become_program, int control, int reports, const ProcessLimits& limits);

}  // namespace forceshade::files
