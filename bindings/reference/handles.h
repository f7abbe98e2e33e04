// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A definition behind a handle of include/forceshade_reference.h.

#include "bindings/c/table.h"
#include "bindings/reference/definition.h"
#include "forceshade/description.h"
#include "forceshade_reference.h"

namespace forceshade::exact {

struct Defined {
  Description description;  // for properties and certificates
  Definition definition;
};

extern constinit c::Lasting<Defined> definitions;

// These are called by what c::guarded() calls, which they end for an invalid handle, and for a thread whose arithmetic is at
// fault.
const Defined& defined(forceshade_reference handle);
void expect_arithmetic();

}  // namespace forceshade::exact
