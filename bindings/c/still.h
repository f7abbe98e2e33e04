// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rejects descriptions with moving objects, of which a binding makes no subject.

#include "forceshade/description.h"
#include "forceshade/error.h"

namespace forceshade::c {

// Throws Error for a scene with motions: a program gives the poses of each tick itself.
inline void expect_still(const Description& description) {
  if (description.moves())
    throw Error(description.name +
                ": expected no object with a motion here; a session of a scene takes the poses of each tick");
}

}  // namespace forceshade::c
