// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of a certificate side by side: continuous, unit, conservative, energy per loop.

#include <string>

#include "forceshade/certificate/certificate.h"

namespace forceshade::properties {

// A <section> with one row per law; empty where no law was checked.
std::string matrix(const Certificate& certificate);

}  // namespace forceshade::properties
