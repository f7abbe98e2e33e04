// SPDX-License-Identifier: BSD-3-Clause
// In place of subject_files.cpp in a build without them.

#include "bindings/c/errors.h"
#include "forceshade.h"

namespace {

forceshade_result left_out() {
  return forceshade::c::fail(FORCESHADE_LEFT_OUT,
                             "subject files cannot be read: this build was configured without the feature subject-files");
}

}  // namespace

forceshade_result forceshade_subject_read(const char*, forceshade_subject*) {
  return left_out();
}

forceshade_result forceshade_subject_parse(const char*, size_t, const char*, forceshade_subject*) {
  return left_out();
}
