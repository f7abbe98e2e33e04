// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What this program was built from and with.

#include "forceshade/properties/certificate.h"

namespace forceshade::properties {

Build current_build();

}  // namespace forceshade::properties
