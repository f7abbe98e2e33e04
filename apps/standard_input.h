// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Standard input, as commands read it.

#include <istream>

namespace forceshade::apps {

// A wait for it ends with Interrupted where a signal comes that is to end the work; std::cin would wait on, or call it an
// error. Any other failure is a std::ios_base::failure.
std::istream& standard_input();

}  // namespace forceshade::apps
