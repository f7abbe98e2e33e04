// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject behind a handle of the C interface.

#include "bindings/c/described.h"
#include "bindings/c/table.h"
#include "forceshade.h"

namespace forceshade::c {

extern constinit Lasting<Subject> subjects;

// Null for an invalid handle, for which bad_subject() is the result.
inline const Subject* subject_of(forceshade_subject handle) noexcept {
  return subjects.table.find(handle.handle);
}
forceshade_result bad_subject() noexcept;

// The handle of what is described, or the error.
forceshade_result add_subject(const Description& description, forceshade_subject* made);

}  // namespace forceshade::c
