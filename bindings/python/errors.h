// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// forceshade.Error of Python.

#include <stdexcept>

namespace forceshade::python {

// A refusal that is no wrong value or type: of a file, of this thread's arithmetic, of a session that another thread is in.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace forceshade::python
