// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject behind a handle of the C interface.

#include "bindings/c/described.h"
#include "bindings/c/table.h"
#include "forceshade.h"

namespace forceshade::c {

extern constinit Lasting<Subject> subjects;

// Says BAD_HANDLE.
const Subject* no_subject() noexcept;

// Null for a handle that is none; then BAD_HANDLE has been said.
inline const Subject* subject_of(forceshade_subject handle) noexcept {
  const Subject* const found = subjects.table.find(handle.handle);
  return found != nullptr ? found : no_subject();
}

// The handle of what is described, or the error.
forceshade_result add_subject(const Description& description, forceshade_subject* made);

}  // namespace forceshade::c
