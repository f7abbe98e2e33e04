// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers in words.

#include <string>

namespace forceshade::files {

// The shortest decimal that reads back as the same number.
std::string shortest(float value);
std::string shortest(double value);

}  // namespace forceshade::files
