// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rejects descriptions with moving objects, of which a binding makes no subject.

#include "forceshade/bad_input.h"
#include "forceshade/description.h"

namespace forceshade::c {

// Throws files::BadInput for a scene with motions: a program gives the poses of each tick itself.
inline void expect_still(const Description& description) {
  if (std::holds_alternative<DescribedScene>(description.what))
    throw files::BadInput(description.name +
                          ": expected no object with a motion here; a session of a scene takes the poses of each tick");
}

}  // namespace forceshade::c
