// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Words for a command line.

#include <string>

namespace forceshade::files {

// As one word of a command line.
std::string quoted_for_shell(const std::string& word);

}  // namespace forceshade::files
