// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The machine of a certificate, beside current_build() of include/forceshade/certificate.h.

#include "forceshade/certificate.h"

namespace forceshade::properties {

// The name by which the processor calls itself; "unknown" where the system does not say.
std::string processor_name();

}  // namespace forceshade::properties
