// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a certificate covers a subject of the C interface.

#include "bindings/c/errors.h"
#include "bindings/c/subject.h"
#include "forceshade.h"
#include "forceshade/certificate.h"

using namespace forceshade;

forceshade_result forceshade_certificate_covers(const char* file, forceshade_subject subject) {
  return c::guarded([&]() -> forceshade_result {
    if (file == nullptr) return c::fail(FORCESHADE_NULL_POINTER, "file is NULL");
    const c::Subject* const its = c::subject_of(subject);
    if (its == nullptr) return c::bad_subject();
    const properties::Certificate certificate = properties::from_json(properties::read_certificate(file), file);
    const auto refused = refusal(certificate, properties::current_build(), its->identity);
    return refused ? c::fail(FORCESHADE_NOT_COVERED, std::string(file) + ": " + *refused) : FORCESHADE_OK;
  });
}
