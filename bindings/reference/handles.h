// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A definition behind a handle of include/forceshade_reference.h.

#include "bindings/c/table.h"
#include "bindings/reference/definition.h"
#include "forceshade/description.h"
#include "forceshade_reference.h"

namespace forceshade::exact {

struct Defined {
  Description description;  // what properties and certificates are made of
  Definition definition;
};

extern constinit c::Lasting<Defined> definitions;

// Null for a handle that is none; then BAD_HANDLE has been said.
const Defined* defined(forceshade_reference handle) noexcept;

// OK, or the fault of the calling thread's arithmetic, which has been said.
forceshade_result check_arithmetic() noexcept;

// What a parameter outside its domain is, with its sentence.
forceshade_result refuse(const ParameterError& error);

}  // namespace forceshade::exact
