// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A build in JSON, the same in a certificate and in a plan.

#include <string>

#include "certificate/json_fields.h"
#include "forceshade/certificate.h"

namespace forceshade::properties {

nlohmann::ordered_json build_json(const Build& build);

// Throws Error.
Build build_from(Fields fields);

// The member is a SHA-256 of 64 hex digits. Throws Error.
std::string digest_from(Fields& fields, const char* key);

}  // namespace forceshade::properties
