// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pictures of a certificate, drawn from the fast path of this program.

#include <string>

#include "forceshade/certificate.h"

namespace forceshade::properties {

// One <figure> after another: force along the surface, nominal surfaces, rounding errors, energy per loop. A law that was
// certified twice is drawn once; a figure with nothing to show is left out. Throws Error.
std::string figures(const Certificate& certificate);

}  // namespace forceshade::properties
