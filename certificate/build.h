// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What this program was built from and with.

#include "certificate/certificate.h"

namespace forceshade::properties {

Build current_build();

// The name by which the processor calls itself; "unknown" where the system does not say.
std::string processor_name();

// 2026-01-31T23:59:59Z
std::string utc_now();

}  // namespace forceshade::properties
