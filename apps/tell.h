// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines of a program to its user, on standard error.

#include <string>

namespace forceshade::apps {

// The name with which each line begins: "forceshade", unless a program of another name sets it at its start.
std::string& program_name();

// "forceshade: WORDS", made printable as one line.
void tell(const std::string& words);

}  // namespace forceshade::apps
