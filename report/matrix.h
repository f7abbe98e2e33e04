// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The laws of a certificate side by side: continuous, unit, conservative, energy per loop.

#include <string>

#include "forceshade/certificate.h"

namespace forceshade::properties {

// "law", "height map" or "mesh" where all subjects are of that kind, else "subject". The certificate has a subject.
std::string subject_word(const Certificate& certificate);

// A <section> with one row per law; empty where no law was checked.
std::string matrix(const Certificate& certificate);

}  // namespace forceshade::properties
