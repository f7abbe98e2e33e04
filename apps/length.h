// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lengths as people write them: 15.24, 15.24mm, 600mil, 0.6in, 2.54cm, 0.01m.

#include <string>

namespace forceshade::apps {

// The binary32 number of millimetres nearest to the length. `name` is what a message calls it. Throws BadInput.
float parse_length(const std::string& name, const std::string& text);

// A stiffness in N/mm, with or without that unit, or in N/m.
float parse_stiffness(const std::string& name, const std::string& text);

}  // namespace forceshade::apps
