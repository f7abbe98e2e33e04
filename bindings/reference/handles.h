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

// Null for an invalid handle, after setting the error text for BAD_HANDLE.
const Defined* defined(forceshade_reference handle) noexcept;

// Returns OK, or an error code after setting the error text, if the calling thread's arithmetic is at fault.
forceshade_result check_arithmetic() noexcept;

// The result for a parameter outside its domain, with its sentence.
forceshade_result refuse(const ParameterError& error);

}  // namespace forceshade::exact
