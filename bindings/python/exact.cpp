// SPDX-License-Identifier: BSD-3-Clause
// The exact side.

#include "bindings/python/arrays.h"
#include "bindings/python/errors.h"
#include "bindings/python/subject.h"
#include "forceshade/reference.h"

namespace forceshade::python {

void add_exact(py::module_&) {}

}  // namespace forceshade::python
