// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a subcommand ends before its work is done. This header is apart from command.h because CLI11 takes seconds to compile.

#include <stdexcept>

namespace forceshade::apps {

// Becomes exit code 2; what() says what was expected and what was got.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The same with several lines in what(), such as the faults of a mesh; each is printed as a line. What comes from a user or a
// file is printable() in it, so that no name can begin a line.
struct BadInputOfLines : BadInput {
  using BadInput::BadInput;
};

}  // namespace forceshade::apps
