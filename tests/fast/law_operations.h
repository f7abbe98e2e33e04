// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The operations of the laws' headers beside those of the Gappa scripts.

#include <map>
#include <string>

#include "tests/fast/recorded_run.h"

namespace forceshade::tests {

using Compare = void (*)(ComparedScript& script, bool is_fused);

// By the name of the script below fast/, without its end.
std::map<std::string, Compare> comparisons_of_laws();

}  // namespace forceshade::tests
