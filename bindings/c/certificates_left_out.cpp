// SPDX-License-Identifier: BSD-3-Clause
// In place of certificates.cpp in a build without them.

#include "bindings/c/errors.h"
#include "forceshade.h"

forceshade_result forceshade_certificate_covers(const char*, forceshade_subject) {
  return forceshade::c::fail(FORCESHADE_LEFT_OUT,
                             "certificates cannot be read: this build was configured without the feature certificates");
}
