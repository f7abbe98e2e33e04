// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The forceshade command as a function.

#include <string>
#include <vector>

namespace forceshade::apps {

// arguments: the words after the program's name. Once in a process: it uses the standard streams and the signals of the
// process. Returns the exit code: 0 held, 1 a check failed, 2 bad usage or input, 3 device fault, 130 interrupted.
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace forceshade::apps
