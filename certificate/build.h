// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The machine and the time of a certificate, beside current_build() of include/forceshade/certificate.h.

#include "forceshade/certificate.h"

namespace forceshade::properties {

// The name by which the processor calls itself; "unknown" where the system does not say.
std::string processor_name();

// 2026-01-31T23:59:59Z
std::string utc_now();

}  // namespace forceshade::properties
