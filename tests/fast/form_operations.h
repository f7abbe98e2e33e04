// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The operations of the batch's forms beside those of their Gappa scripts.

#include "tests/fast/law_operations.h"

namespace forceshade::tests {

// By the name of the script below fast/, without its end.
std::map<std::string, Compare> comparisons_of_forms();

}  // namespace forceshade::tests
